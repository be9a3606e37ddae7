#include "core/tracking/landmark_term.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace scantrove {
namespace {
constexpr double kOutlier_px = 2.0;     // larger errors are mismatches and count linearly (Huber)
constexpr int kColumns = 8, kRows = 6;  // cells of 80 x 80 pixels at 640 x 480
}  // namespace

void SeenLandmarks::append(const SeenLandmarks& others) {
  points_world.insert(points_world.end(), others.points_world.begin(), others.points_world.end());
  pixels.insert(pixels.end(), others.pixels.begin(), others.pixels.end());
}

int SeenLandmarks::cells() const {
  std::set<std::pair<int, int>> held;
  for (const Eigen::Vector2d& pixel : pixels)
    held.emplace(static_cast<int>(pixel.x()) * kColumns / K.width,
                 static_cast<int>(pixel.y()) * kRows / K.height);
  return static_cast<int>(held.size());
}

double SeenLandmarks::errorPx(const Eigen::Isometry3d& T_world_depth) const {
  const Eigen::Isometry3d T_color_world = T_color_depth * T_world_depth.inverse();
  const Eigen::Vector2d f(static_cast<double>(K.fx), static_cast<double>(K.fy));
  const Eigen::Vector2d c(static_cast<double>(K.cx), static_cast<double>(K.cy));
  std::vector<double> errors;
  for (std::size_t i = 0; i < points_world.size(); ++i) {
    const Eigen::Vector3d q = T_color_world * points_world[i];
    const Eigen::Vector2d seen_at = f.cwiseProduct(q.head<2>()) / q.z() + c;
    errors.push_back(q.z() > double{kNearestLandmark_m} ? (pixels[i] - seen_at).norm()
                                                        : std::numeric_limits<double>::infinity());
  }
  if (errors.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::ranges::nth_element(errors, middle);
  return *middle;
}

LandmarkTerm LandmarkTerm::of(const SeenLandmarks& seen, const Eigen::Isometry3d& T_world_depth,
                              const Eigen::Vector3d& center) {
  LandmarkTerm term;
  const Eigen::Isometry3d T_color_world = seen.T_color_depth * T_world_depth.inverse();
  const auto fx = static_cast<double>(seen.K.fx);
  const auto fy = static_cast<double>(seen.K.fy);
  // Errors are in units of columns; rows may differ in height.
  const Eigen::Vector2d columns(1, fy / fx);
  for (std::size_t i = 0; i < seen.points_world.size(); ++i) {
    const Eigen::Vector3d q = T_color_world * seen.points_world[i];
    if (q.z() < double{kNearestLandmark_m}) continue;
    const Eigen::Vector2d direction((seen.pixels[i].x() - static_cast<double>(seen.K.cx)) / fx,
                                    (seen.pixels[i].y() - static_cast<double>(seen.K.cy)) / fy);
    const Eigen::Vector2d error = columns.cwiseProduct(q.z() * direction - q.head<2>());
    const double error_px = fx * error.norm() / q.z();
    const double w = std::min(1.0, kOutlier_px / std::max(error_px, 1e-12)) / (q.z() * q.z());

    // The camera moves by the twist, so points move the other way, by -(rotation x arm + translation).
    Eigen::Matrix<double, 2, 3> flatten;
    flatten << 1, 0, -q.x() / q.z(), 0, 1, -q.y() / q.z();
    const Eigen::Matrix<double, 2, 3> across = columns.asDiagonal() * (flatten * T_color_world.linear());
    const Eigen::Vector3d arm = seen.points_world[i] - center;
    Eigen::Matrix<double, 2, 6> J;
    for (int row = 0; row < 2; ++row) {
      const Eigen::Vector3d a = across.row(row).transpose();
      J.row(row) << arm.cross(a).transpose(), a.transpose();
    }
    term.JtJ += w * J.transpose() * J;
    term.Jtr -= w * J.transpose() * error;
  }
  term.weight = term.JtJ.bottomRightCorner<3, 3>().trace();
  return term;
}

}  // namespace scantrove
