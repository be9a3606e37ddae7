#pragma once
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"
#include "core/segmentation/segmentation_params.h"

namespace scantrove {

/// The weighted pixel graph of one frame, on the host, in the order of edge_layout.h.
struct EdgeKeys {
  int width = 0;
  int height = 0;
  std::vector<cl_ushort4> keys;  ///< per pixel: E, S, SE, SW
  std::vector<float> depths_m;   ///< per pixel: z in the camera, 0 where vertex or normal is missing
};

/// Launches weigh_edges: eq. 3.5 on V_t, N_t. One thread, the context's; may throw cl::Error.
class EdgeWeigher {
 public:
  [[nodiscard]] static Result<EdgeWeigher> create(ComputeContext& compute);

  /// Sets `edges` to the weights between the vertices of `surface` with `normals`
  /// (SurfaceMaps::normals_world, or refined). Keeps buffers of device and host between frames of one size.
  void weigh(const SurfaceMaps& surface, const Buffer<cl_float4>& normals, const SegmentationParams& params,
             EdgeKeys& edges);

 private:
  EdgeWeigher(ComputeContext& compute, Kernel kernel) : compute_(&compute), kernel_(std::move(kernel)) {}

  ComputeContext* compute_;
  Kernel kernel_;
  Buffer<cl_ushort4> keys_;
  Buffer<cl_float> depths_;
};

}  // namespace scantrove
