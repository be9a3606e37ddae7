#include "core/session/painted_image.h"

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/dataset/aligned_view.h"
#include "core/dataset/painted_masks.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/key_frame_files.h"
#include "core/session/mask_corrections.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

/// Greatest difference of depth of one surface in two cameras of a frame.
constexpr float kOneSurface_m = 0.03F;

}  // namespace

Result<std::optional<PaintedImage>> PaintedImage::of(OpenSession& session, const SavedKeyFrame& key_frame) {
  const SavedFrame* frame = session.frameOf(key_frame);
  const std::vector<PaintedMask> masks =
      paintedMasksOf(session.history(), session.pipeline().labels().table(), key_frame.frame);
  if (frame == nullptr || masks.empty()) return std::optional<PaintedImage>();
  const KeyFrameInfo info = SessionScan::infoOf(session, key_frame, *frame);
  const bool has_color = !info.color_file.empty();
  SessionScan scan(session);
  const Result<RgbdFrame> images = readKeyFrame(session.folder(), key_frame, *frame);
  const auto T = alignedPoseOf(scan, info, images ? images->depth : cv::Mat());
  if (!T) return fail(T.error());
  PaintedImage image;
  image.K_ = has_color ? info.K_color : info.K_depth;
  image.T_camera_world_ = T->inverse().cast<float>();
  Result<ViewOfMap> view = scan.renderView(image.K_, *T);
  if (!view) return fail(view.error());
  applyPaintedMasks(masks, view->regions);
  image.regions_ = std::move(view->regions);
  image.depth_m_ = std::move(view->depth_m);
  return std::optional(std::move(image));
}

RegionId PaintedImage::regionAt(const Eigen::Vector3f& point_world, RegionId otherwise) const {
  const Eigen::Vector3f seen = T_camera_world_ * point_world;
  if (!(seen.z() > 0)) return otherwise;
  const float u = K_.fx * seen.x() / seen.z() + K_.cx, v = K_.fy * seen.y() / seen.z() + K_.cy;
  const bool is_inside = u >= -0.5F && v >= -0.5F && u < static_cast<float>(K_.width) - 0.5F &&
                         v < static_cast<float>(K_.height) - 0.5F;
  if (!is_inside) return otherwise;
  const cv::Point pixel(static_cast<int>(std::floor(u + 0.5F)), static_cast<int>(std::floor(v + 0.5F)));
  // The colour camera may see something else in front of the point.
  if (std::abs(depth_m_.at<float>(pixel) - seen.z()) > kOneSurface_m) return otherwise;
  return RegionId{static_cast<std::uint32_t>(regions_.at<int>(pixel))};
}

void PaintedImage::applyTo(RenderedView& view) const {
  for (std::size_t i = 0; i < view.regions.size() && i < view.vertices_world.size(); ++i) {
    const Eigen::Vector4f& vertex = view.vertices_world[i];
    if (vertex.w() != 0) view.regions[i] = regionAt(vertex.head<3>(), view.regions[i]);
  }
}

}  // namespace scantrove
