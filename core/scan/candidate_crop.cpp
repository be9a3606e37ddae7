#include "core/scan/candidate_crop.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// `box` of an image of size `from` in an image of size `to`, rounded outwards and kept inside.
cv::Rect scaledBox(const cv::Rect& box, const cv::Size& from, const cv::Size& to) {
  const double sx = static_cast<double>(to.width) / from.width;
  const double sy = static_cast<double>(to.height) / from.height;
  const cv::Point first(static_cast<int>(std::floor(box.x * sx)), static_cast<int>(std::floor(box.y * sy)));
  const cv::Point last(static_cast<int>(std::ceil(box.br().x * sx)),
                       static_cast<int>(std::ceil(box.br().y * sy)));
  return cv::Rect(first, last) & cv::Rect({0, 0}, to);
}

}  // namespace

Eigen::Vector3f directionOf(const Candidate& candidate, const Eigen::Isometry3d& T_world_camera) {
  const Eigen::Vector3f camera_centre = T_world_camera.translation().cast<float>();
  return (camera_centre - candidate.centroid_world).normalized();
}

ObjectView cutView(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                   const Intrinsics& working_K, const Candidate& candidate) {
  const cv::Size working(working_K.width, working_K.height);
  ObjectView view;
  view.frame_index = frame.index;
  view.T_world_camera = T_world_camera;
  view.size_m = candidate.size_m;
  view.direction = directionOf(candidate, T_world_camera);

  const cv::Rect in_color = scaledBox(candidate.box_px, working, frame.color.size());
  view.color = frame.color(in_color).clone();
  cv::resize(candidate.mask, view.mask, in_color.size(), 0, 0, cv::INTER_NEAREST);
  view.frame_px = frame.depth.size();
  view.box_px = scaledBox(candidate.box_px, working, view.frame_px);
  const cv::Mat depth = frame.depth(view.box_px);
  depth.convertTo(view.depth_mm, CV_16U, static_cast<double>(frame.metres_per_unit) * 1000.0);
  if (view.depth_mm.size() != in_color.size()) {
    cv::resize(view.depth_mm, view.depth_mm, in_color.size(), 0, 0, cv::INTER_NEAREST);
  }
  return view;
}

}  // namespace scantrove
