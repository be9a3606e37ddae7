#include "core/dataset/aligned_view.h"

#include <opencv2/core.hpp>
#include <utility>

#include "core/dataset/registered_depth.h"
#include "core/dataset/view_alignment.h"

namespace scantrove {

Result<AlignedView> renderAligned(LabeledScan& scan, const Intrinsics& K,
                                  const Eigen::Isometry3d& T_world_camera, const cv::Mat& measured_m) {
  AlignedView view;
  view.T_world_camera = T_world_camera;
  SCANTROVE_TRY(moveInto(view.map, scan.renderView(K, T_world_camera)));
  if (measured_m.empty()) return view;
  const auto T_rendered_camera = alignToMap(measured_m, view.map.depth_m, K);
  if (!T_rendered_camera) return view;
  view.T_world_camera = T_world_camera * *T_rendered_camera;
  SCANTROVE_TRY(moveInto(view.map, scan.renderView(K, view.T_world_camera)));
  return view;
}

Result<Eigen::Isometry3d> alignedPoseOf(LabeledScan& scan, const KeyFrameInfo& frame, const cv::Mat& depth) {
  KeyFrameInfo camera = frame;
  if (frame.color_file.empty()) {
    camera.K_color = frame.K_depth;
    camera.T_color_depth.setIdentity();
  }
  const Eigen::Isometry3d T_world_camera = camera.colorCameraPose();
  if (depth.cols != frame.K_depth.width || depth.rows != frame.K_depth.height) return T_world_camera;
  const auto map = scan.renderView(camera.K_color, T_world_camera);
  if (!map) return fail(map.error());
  const auto T_rendered_camera = alignToMap(registerDepth(camera, depth), map->depth_m, camera.K_color);
  return T_rendered_camera ? T_world_camera * *T_rendered_camera : T_world_camera;
}

}  // namespace scantrove
