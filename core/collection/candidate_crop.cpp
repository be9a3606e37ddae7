#include "core/collection/candidate_crop.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/capture/usable_depth.h"
#include "core/collection/bounds_in_color.h"

namespace scantrove {
namespace {

/// Pixels around a candidate to which its surface is extended, so that its outline can be drawn between
/// pixels.
constexpr int kMargin_px = 2;

/// `box` in units of an image, rounded outwards with a tolerance for rounding errors, and clipped to the
/// image.
cv::Rect pixelBox(const cv::Rect2d& box, const cv::Size& image) {
  constexpr double kNothing_px = 1e-3;
  const auto down = [](double at) { return static_cast<int>(std::floor(at + kNothing_px)); };
  const auto up = [](double at) { return static_cast<int>(std::ceil(at - kNothing_px)); };
  const cv::Point first(down(box.x), down(box.y));
  const cv::Point last(up(box.br().x), up(box.br().y));
  return cv::Rect(first, last) & cv::Rect({0, 0}, image);
}

cv::Rect2d scaled(const cv::Rect2d& box, double sx, double sy) {
  return {box.x * sx, box.y * sy, box.width * sx, box.height * sy};
}

/// The rectangle that the pixels of `mask` cover in the colour image, in fractions.
cv::Rect2f bounds(const cv::Mat& places, const cv::Mat& mask, const cv::Size& working) {
  BoundsInColor around;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) != 0) around.add(places.at<cv::Vec2f>(y, x));
    }
  }
  return around.box(working);
}

/// The shift of the surface in the colour image, in working pixels, relative to colour of the same camera:
/// CV_32FC2 by pixel of `mask`, which is at `origin` of `places`. Pixels outside `mask` take the value of
/// its nearest pixel.
cv::Mat shiftsAround(const cv::Mat& mask, const cv::Mat& places, const cv::Point& origin) {
  cv::Mat distances, nearest;
  cv::distanceTransform(mask == 0, distances, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec2f> shift_of(mask.total() + 1);  // by label
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      const cv::Point p = origin + cv::Point(x, y);
      const cv::Vec2f& place = places.at<cv::Vec2f>(p);
      shift_of[static_cast<std::size_t>(nearest.at<int>(y, x))] = {
          place[0] * static_cast<float>(places.cols) - 0.5F - static_cast<float>(p.x),
          place[1] * static_cast<float>(places.rows) - 0.5F - static_cast<float>(p.y)};
    }
  }
  cv::Mat shifts(mask.size(), CV_32FC2);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      shifts.at<cv::Vec2f>(y, x) = shift_of[static_cast<std::size_t>(nearest.at<int>(y, x))];
    }
  }
  return shifts;
}

/// For each pixel of `crop` in the colour image, the pixel of `shifts` that is shifted there, CV_32FC2.
/// `to_working`: from colour pixels to working pixels; `origin` is the first of `shifts`.
cv::Mat undoShifts(const cv::Mat& shifts, const cv::Rect& crop, const cv::Vec2f& to_working,
                   const cv::Point& origin) {
  constexpr int kRounds = 2;  // each reduces the error to a tenth, because shifts change slowly
  cv::Mat shifted(crop.size(), CV_32FC2);
  for (int y = 0; y < crop.height; ++y) {
    auto* row = shifted.ptr<cv::Vec2f>(y);
    const float at_y = (static_cast<float>(crop.y + y) + 0.5F) * to_working[1] - 0.5F;
    for (int x = 0; x < crop.width; ++x) {
      const float at_x = (static_cast<float>(crop.x + x) + 0.5F) * to_working[0] - 0.5F;
      row[x] = {at_x - static_cast<float>(origin.x), at_y - static_cast<float>(origin.y)};
    }
  }
  cv::Mat pixels = shifted - cv::mean(shifts);
  for (int round = 0; round < kRounds; ++round) {
    cv::Mat shift;
    cv::remap(shifts, shift, pixels, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::subtract(shifted, shift, pixels);
  }
  return pixels;
}

cv::Mat visiblePart(const SurfaceInColor& in_color, const Candidate& candidate) {
  return candidate.mask & (in_color.hidden(candidate.box_px) == 0);
}

}  // namespace

Eigen::Vector3f directionOf(const Candidate& candidate, const Eigen::Isometry3d& T_world_camera) {
  const Eigen::Vector3f camera_center = T_world_camera.translation().cast<float>();
  return (camera_center - candidate.centroid_world).normalized();
}

cv::Rect2f boxInColor(const SurfaceInColor& in_color, const Candidate& candidate) {
  const cv::Mat visible = visiblePart(in_color, candidate);
  const bool is_seen = cv::countNonZero(visible) > 0;
  return bounds(in_color.places(candidate.box_px), is_seen ? visible : candidate.mask,
                in_color.places.size());
}

std::optional<ObjectView> cropView(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                   const SurfaceInColor& in_color, const Candidate& candidate) {
  const cv::Size working = in_color.places.size();
  const cv::Size color = frame.color.size();
  cv::Mat visible = visiblePart(in_color, candidate);
  const cv::Rect tight = cv::boundingRect(visible);
  if (tight.empty()) return std::nullopt;
  const cv::Rect2d place = bounds(in_color.places(candidate.box_px), visible, working);
  const cv::Rect crop = pixelBox(scaled(place, color.width, color.height), color);

  ObjectView view;
  view.frame_index = frame.index;
  view.T_world_camera = T_world_camera;
  view.size_m = candidate.size_m;
  view.direction = directionOf(candidate, T_world_camera);
  view.centroid_world = candidate.centroid_world;
  view.color = frame.color(crop).clone();
  view.frame_px = frame.depth.size();
  const double sx = static_cast<double>(view.frame_px.width) / working.width;
  const double sy = static_cast<double>(view.frame_px.height) / working.height;
  view.box_px = pixelBox(scaled(tight + candidate.box_px.tl(), sx, sy), view.frame_px);

  cv::copyMakeBorder(visible, visible, kMargin_px, kMargin_px, kMargin_px, kMargin_px, cv::BORDER_CONSTANT,
                     0);
  const cv::Point origin = candidate.box_px.tl() - cv::Point(kMargin_px, kMargin_px);
  const cv::Mat shifts = shiftsAround(visible, in_color.places, origin);
  const cv::Vec2f to_working(static_cast<float>(working.width) / static_cast<float>(color.width),
                             static_cast<float>(working.height) / static_cast<float>(color.height));
  const cv::Mat pixels = undoShifts(shifts, crop, to_working, origin);
  cv::remap(visible, view.mask, pixels, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  view.mask = view.mask > 127;

  cv::Mat depth_pixels = pixels + cv::Scalar(origin.x + 0.5, origin.y + 0.5);
  cv::multiply(depth_pixels, cv::Scalar(sx, sy), depth_pixels);
  depth_pixels -= cv::Scalar(0.5, 0.5);
  cv::Mat depth;
  cv::remap(usableDepth(frame), depth, depth_pixels, {}, cv::INTER_NEAREST, cv::BORDER_CONSTANT, 0);
  depth.convertTo(view.depth_mm, CV_16U, static_cast<double>(frame.meters_per_unit) * 1000.0);
  return view;
}

}  // namespace scantrove
