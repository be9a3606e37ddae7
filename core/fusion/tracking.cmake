set(tracking_sources depth_preprocessor.cpp icp_pass.cpp icp_system.cpp pose_judgement.cpp tracker.cpp)
set(tracking_kernels
  kernels/convert_depth.cl kernels/reduce_depth.cl kernels/halve_depth.cl kernels/filter_depth.cl kernels/build_surface.cl
  kernels/accumulate_icp.cl)
