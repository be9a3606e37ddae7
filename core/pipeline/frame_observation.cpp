#include "core/pipeline/frame_observation.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/capture/usable_depth.h"
#include "core/fusion/contradicted_surface.h"

namespace scantrove {
namespace {

std::vector<Eigen::Vector3f> labColors(const RgbdFrame& frame, const Intrinsics& K,
                                       const SurfaceInColor& in_color) {
  if (frame.color.empty()) return {};
  cv::Mat small, soft, lab;
  const cv::Size size(K.width, K.height);
  cv::resize(frame.color, small, size, 0, 0, cv::INTER_AREA);
  if (frame.color_camera) {
    cv::Mat seen;
    cv::remap(small, seen, pixelsOf(in_color.places, size), {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    small = seen;
  }
  cv::blur(small, soft, {3, 3});
  soft.convertTo(soft, CV_32F, 1.0 / 255);
  cv::cvtColor(soft, lab, cv::COLOR_BGR2Lab);
  static_assert(sizeof(cv::Vec3f) == sizeof(Eigen::Vector3f));
  const auto* first = reinterpret_cast<const Eigen::Vector3f*>(lab.ptr<float>());
  return {first, first + lab.total()};
}

}  // namespace

FrameObservation observe(const RgbdFrame& frame, const RenderedView& view, SurfaceInColor in_color,
                         float depth_noise_m) {
  FrameObservation observed;
  observed.color_lab = labColors(frame, view.K, in_color);
  observed.in_color = std::move(in_color);
  observed.depth = {view.K.resizedTo(frame.depth.cols, frame.depth.rows), view.T_world_camera, {}};
  usableDepth(frame).convertTo(observed.depth.z_m, CV_32F, static_cast<double>(frame.meters_per_unit));
  observed.contradicted = contradictedSurface(observed.depth, view, depth_noise_m);
  return observed;
}

}  // namespace scantrove
