# The dense map: bricks, integration, raycast.
set(mapping_sources brick_allocator.cpp brick_index.cpp brick_map.cpp brick_pages.cpp brick_window.cpp dense_map.cpp
    integrator.cpp raycaster.cpp view_frustum.cpp)
set(mapping_kernels kernels/cast_rays.cl kernels/orient_surface.cl kernels/find_missing_bricks.cl kernels/fit_planes.cl kernels/integrate_bricks.cl
    kernels/list_missing_bricks.cl kernels/reduce_depth_tiles.cl kernels/find_brick_readings.cl)
