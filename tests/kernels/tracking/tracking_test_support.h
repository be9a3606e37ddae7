#pragma once
#include <vector>

#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/poses.h"

namespace scantrove::test {

inline const Intrinsics kKinect{585, 585, 320, 240, 640, 480};

/// The frame of a camera at `T_world_camera`. Depth is in units of 0.2 mm (TUM's scale), so that rounding is
/// negligible.
inline RgbdFrame frameOf(const AnalyticScene& scene, const Intrinsics& K,
                         const Eigen::Isometry3d& T_world_camera) {
  RgbdFrame frame;
  frame.meters_per_unit = 0.0002F;
  frame.depth = cv::Mat::zeros(K.height, K.width, CV_16UC1);
  const std::vector<float> depth_m = scene.depth(K, T_world_camera);
  for (int i = 0; i < K.pixels(); ++i) {
    const float z = depth_m[static_cast<std::size_t>(i)];
    if (z < 13)
      frame.depth.at<std::uint16_t>(i / K.width, i % K.width) = static_cast<std::uint16_t>(z * 5000 + 0.5F);
  }
  return frame;
}

/// The exact vertex and normal maps V_t and N_t of `scene`.
inline SurfaceMaps mapsOf(ComputeContext& compute, const AnalyticScene& scene, const Intrinsics& K,
                          const Eigen::Isometry3d& T_world_camera) {
  const auto element = [](const Eigen::Vector3d& p) -> cl_float4 {
    return {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1.0F}};
  };
  std::vector<cl_float4> vertices, normals;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const auto hit = scene.seenBy(K, T_world_camera, u, v);
      const Eigen::Vector3d ray =
          K.backProject(static_cast<float>(u), static_cast<float>(v), 1.0F).cast<double>();
      vertices.push_back(hit ? element(T_world_camera * (hit->t * ray)) : cl_float4{});
      normals.push_back(hit ? element(hit->normal) : cl_float4{});
    }
  }
  SurfaceMaps maps{.K = K, .T_world_camera = T_world_camera, .vertices_world = {}, .normals_world = {}};
  maps.vertices_world = Buffer<cl_float4>(compute.context(), vertices.size());
  maps.normals_world = Buffer<cl_float4>(compute.context(), normals.size());
  maps.vertices_world.write(compute.queue(), vertices);
  maps.normals_world.write(compute.queue(), normals);
  return maps;
}

/// A corner of a room with two balls, which determines all directions of motion.
inline AnalyticScene roomCorner() {
  AnalyticScene scene;
  scene.plane({0, 0, 2.5}, {0.3, 0, -1}).plane({-1.2, 0, 0}, {1, 0, 0}).plane({0, 0.9, 0}, {0, -1, 0.1});
  scene.sphere({0.3, 0.5, 1.6}, 0.3).sphere({-0.5, -0.2, 2.0}, 0.25);
  return scene;
}

}  // namespace scantrove::test
