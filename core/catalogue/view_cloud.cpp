#include "core/catalogue/view_cloud.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <tuple>
#include <utility>

namespace scantrove {
namespace {

/// Steps in depth between neighbouring pixels that are no surface: more than this part of the depth.
constexpr float kDepthStep = 0.03F;
constexpr float kLeastSpacing_m = 0.001F;
constexpr double kMostPixels = 40'000;  ///< of one view; larger ones are read in steps

bool isUsable(const ObjectView& view, const std::map<std::int64_t, Intrinsics>& cameras) {
  const auto camera = cameras.find(view.session);
  return camera != cameras.end() && camera->second.width > 0 && camera->second.height > 0 &&
         camera->second.fx > 0 && camera->second.fy > 0 && !view.frame_px.empty() && !view.box_px.empty() &&
         !view.color.empty() && !view.mask.empty() && !view.depth_mm.empty();
}

/// The session with most usable views; 0: none.
std::int64_t bestSession(std::span<const ObjectView> views,
                         const std::map<std::int64_t, Intrinsics>& cameras) {
  std::map<std::int64_t, int> counts;
  for (const ObjectView& view : views) counts[view.session] += isUsable(view, cameras) ? 1 : 0;
  std::pair<int, std::int64_t> best{0, 0};
  for (const auto& [session, count] : counts) best = std::max(best, std::pair(count, session));
  return best.first > 0 ? best.second : 0;
}

/// The pixels of one view as points of its camera.
class ViewPixels {
 public:
  ViewPixels(const ObjectView& view, const Intrinsics& camera)
      : view_(view),
        K_(camera.resizedTo(view.frame_px.width, view.frame_px.height)),
        x_per_pixel_(static_cast<float>(view.box_px.width) / static_cast<float>(view.mask.cols)),
        y_per_pixel_(static_cast<float>(view.box_px.height) / static_cast<float>(view.mask.rows)),
        step_(std::max(1, static_cast<int>(std::lround(
                              std::sqrt(static_cast<double>(view.mask.total()) / kMostPixels))))) {}

  /// From pixel to pixel.
  [[nodiscard]] int step() const { return step_; }

  /// None: outside of the mask or of the picture, or without depth.
  [[nodiscard]] std::optional<Eigen::Vector3f> at(int row, int column) const {
    if (row < 0 || column < 0 || row >= view_.mask.rows || column >= view_.mask.cols) return std::nullopt;
    const int depth_mm = view_.depth_mm.at<std::uint16_t>(row, column);
    if (depth_mm == 0 || view_.mask.at<std::uint8_t>(row, column) == 0) return std::nullopt;
    const float u = static_cast<float>(view_.box_px.x) + (static_cast<float>(column) + 0.5F) * x_per_pixel_;
    const float v = static_cast<float>(view_.box_px.y) + (static_cast<float>(row) + 0.5F) * y_per_pixel_;
    return K_.backProject(u - 0.5F, v - 0.5F, static_cast<float>(depth_mm) / 1000);
  }

  /// From the neighbours of a pixel with this point; zero: a neighbour has no surface beside it.
  [[nodiscard]] Eigen::Vector3f normalAt(int row, int column, const Eigen::Vector3f& here) const {
    const auto left = at(row, column - step_), right = at(row, column + step_);
    const auto above = at(row - step_, column), below = at(row + step_, column);
    for (const auto& neighbour : {left, right, above, below}) {
      if (!neighbour || std::abs(neighbour->z() - here.z()) > kDepthStep * here.z())
        return Eigen::Vector3f::Zero();
    }
    const Eigen::Vector3f normal = (*right - *left).cross(*below - *above);
    if (!(normal.norm() > 0)) return Eigen::Vector3f::Zero();
    const Eigen::Vector3f unit = normal.normalized();
    return unit.dot(here) > 0 ? Eigen::Vector3f(-unit) : unit;
  }

 private:
  const ObjectView& view_;
  Intrinsics K_;
  float x_per_pixel_, y_per_pixel_;
  int step_;
};

void appendPoints(const ObjectView& view, const Intrinsics& camera, std::vector<ViewPoint>& points) {
  const ViewPixels pixels(view, camera);
  const Eigen::Isometry3f T = view.T_world_camera.cast<float>();
  for (int row = 0; row < view.mask.rows; row += pixels.step()) {
    for (int column = 0; column < view.mask.cols; column += pixels.step()) {
      const auto here = pixels.at(row, column);
      if (!here) continue;
      const Eigen::Vector3f normal = pixels.normalAt(row, column, *here);
      // Without neighbours at its depth it is often a flying pixel at an edge.
      if (normal.isZero()) continue;
      const cv::Vec3b bgr = view.color.at<cv::Vec3b>(row, column);
      points.push_back({T * *here, T.linear() * normal, {bgr[2], bgr[1], bgr[0]}});
    }
  }
}

/// Keeps the first of the points in each cell of this size.
std::vector<ViewPoint> thinned(std::vector<ViewPoint> points, float spacing_m) {
  const auto cellOf = [spacing_m](const ViewPoint& point) {
    const Eigen::Vector3i cell = (point.position / spacing_m).array().floor().cast<int>().matrix();
    return std::tuple(cell.x(), cell.y(), cell.z());
  };
  std::ranges::stable_sort(points, {}, cellOf);
  const auto rest = std::unique(points.begin(), points.end(), [&](const ViewPoint& a, const ViewPoint& b) {
    return cellOf(a) == cellOf(b);
  });
  points.erase(rest, points.end());
  return points;
}

}  // namespace

ViewCloud cloudOfViews(std::span<const ObjectView> views, const std::map<std::int64_t, Intrinsics>& cameras) {
  ViewCloud cloud;
  cloud.session = bestSession(views, cameras);
  if (cloud.session == 0) return cloud;
  std::vector<ViewPoint> points;
  for (const ObjectView& view : views) {
    if (view.session != cloud.session || !isUsable(view, cameras)) continue;
    appendPoints(view, cameras.at(view.session), points);
    ++cloud.views;
  }
  Eigen::AlignedBox3f box;
  for (const ViewPoint& point : points) box.extend(point.position);
  if (points.empty()) return cloud;
  cloud.spacing_m = std::max(kLeastSpacing_m, box.sizes().maxCoeff() / static_cast<float>(kCloudSteps));
  cloud.points = thinned(std::move(points), cloud.spacing_m);
  return cloud;
}

}  // namespace scantrove
