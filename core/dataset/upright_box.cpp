#include "core/dataset/upright_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace scantrove {
namespace {

constexpr std::size_t kMaxPoints = 8192;
constexpr double kStrayFraction = 0.005;
constexpr double kPi = std::numbers::pi;

/// Middle and length of a range of values without its outermost ones; reorders them.
std::pair<double, double> extentOf(std::vector<double>& values) {
  const auto stray = static_cast<std::ptrdiff_t>(kStrayFraction * static_cast<double>(values.size()));
  const auto low = values.begin() + stray, high = values.end() - 1 - stray;
  std::nth_element(values.begin(), low, values.end());
  const double least = *low;  // the next selection moves it
  std::nth_element(low, high, values.end());
  return {(least + *high) / 2, *high - least};
}

class BoxFit {
 public:
  explicit BoxFit(std::span<const Eigen::Vector3f> points) {
    const std::size_t step = std::max<std::size_t>(1, (points.size() + kMaxPoints - 1) / kMaxPoints);
    for (std::size_t i = 0; i < points.size(); i += step) points_.push_back(points[i].cast<double>());
    values_.resize(points_.size());
  }

  UprightBox atYaw(double yaw) {
    const Eigen::Vector3d x(std::cos(yaw), std::sin(yaw), 0), y(-x.y(), x.x(), 0);
    const auto [middle_x, length_x] = along(x);
    const auto [middle_y, length_y] = along(y);
    const auto [middle_z, length_z] = along(Eigen::Vector3d::UnitZ());
    return {
        middle_x * x + middle_y * y + Eigen::Vector3d(0, 0, middle_z), {length_x, length_y, length_z}, yaw};
  }

  double baseAt(double yaw) {
    const Eigen::Vector3d x(std::cos(yaw), std::sin(yaw), 0);
    return along(x).second * along({-x.y(), x.x(), 0}).second;
  }

 private:
  std::pair<double, double> along(const Eigen::Vector3d& axis) {
    std::transform(points_.begin(), points_.end(), values_.begin(),
                   [&](const Eigen::Vector3d& p) { return axis.dot(p); });
    return extentOf(values_);
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> values_;
};

/// The yaw of least base among `from`, `from + step`, ...
double leastBase(BoxFit& fit, double from, double step, int count) {
  double best = from, least = fit.baseAt(from);
  for (int i = 1; i < count; ++i) {
    const double base = fit.baseAt(from + i * step);
    if (base >= least) continue;
    least = base;
    best = from + i * step;
  }
  return best;
}

}  // namespace

std::array<Eigen::Vector3d, 4> UprightBox::levelCorners() const {
  const Eigen::Vector3d x = size.x() / 2 * Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  const Eigen::Vector3d y = size.y() / 2 * Eigen::Vector3d(-std::sin(yaw_rad), std::cos(yaw_rad), 0);
  return {center + x + y, center - x + y, center - x - y, center + x - y};
}

UprightBox fitUprightBox(std::span<const Eigen::Vector3f> points) {
  if (points.empty()) return {};
  BoxFit fit(points);
  constexpr double kDegree = kPi / 180;
  const double coarse = leastBase(fit, 0, 2 * kDegree, 45);
  const double fine = leastBase(fit, coarse - 2 * kDegree, kDegree / 4, 17);
  // Round objects have no yaw; a box gains two percent from half a degree.
  constexpr double kMinGain = 0.02;
  const bool has_yaw = fit.baseAt(fine) < (1 - kMinGain) * fit.baseAt(0);
  UprightBox box = fit.atYaw(has_yaw ? fine : 0);
  if (box.size.x() < box.size.y()) {
    std::swap(box.size.x(), box.size.y());
    box.yaw_rad += kPi / 2;
  }
  box.yaw_rad = std::fmod(box.yaw_rad + 2 * kPi, kPi);
  return box;
}

}  // namespace scantrove
