#include "core/dataset/view_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Points are taken on a grid of this many columns: their number decides the time, not the precision.
constexpr int kColumns = 320;
/// Neighbours on one surface differ by less than this part of their depth.
constexpr float kSurfaceStep = 0.03F;
/// Largest distance of a measured point from its surface, by iteration: poses drift by centimetres, and what
/// is farther off is another thing.
constexpr std::array<double, 10> kGates_m{0.08, 0.08, 0.06, 0.06, 0.05, 0.05, 0.04, 0.04, 0.04, 0.04};
/// Distance at which a point counts half: noise of the map and of structured light at two metres.
constexpr double kNoise_m = 0.01;
/// Weight of the pose as it was, beside a mean weight of 1 of all points. A well seen direction has a
/// curvature of 0.1 and more, so it loses 3 % of its motion; one along which surfaces slide keeps its pose.
constexpr double kStaying = 0.003;
/// A larger motion is no error of a pose that was tracked.
constexpr double kMaxShift_m = 0.08, kMaxTurn_rad = 0.07;
/// The map must explain this many points.
constexpr std::size_t kMinPoints = 500;
/// The cost must fall by this part, and by this much for each point: noise moves any pose a little.
constexpr double kMinGain = 0.05, kMinGainOfPoint = 0.004;

struct SurfacePixel {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< zero: none
};

/// A depth image as a surface on a coarse grid.
class DepthSurface {
 public:
  DepthSurface(const cv::Mat& depth_m, const Intrinsics& K)
      : depth_m_(depth_m), K_(K), step_(std::max(1, K.width / kColumns)) {}

  [[nodiscard]] int step() const { return step_; }

  [[nodiscard]] SurfacePixel at(int u, int v) const {
    SurfacePixel pixel;
    const float z = z_m(u, v);
    if (!(z > 0)) return pixel;
    pixel.point = K_.backProject(static_cast<float>(u), static_cast<float>(v), z);
    const float right = z_m(u + step_, v), left = z_m(u - step_, v);
    const float below = z_m(u, v + step_), above = z_m(u, v - step_);
    for (const float other : {right, left, below, above})
      if (!(std::abs(other - z) < kSurfaceStep * z)) return pixel;
    const auto at = [&](int x, int y, float depth) {
      return K_.backProject(static_cast<float>(x), static_cast<float>(y), depth);
    };
    const Eigen::Vector3f across = at(u + step_, v, right) - at(u - step_, v, left);
    const Eigen::Vector3f down = at(u, v + step_, below) - at(u, v - step_, above);
    pixel.normal = down.cross(across).normalized();
    return pixel;
  }

 private:
  [[nodiscard]] float z_m(int u, int v) const { return K_.isInside(u, v) ? depth_m_.at<float>(v, u) : 0; }

  const cv::Mat& depth_m_;
  const Intrinsics& K_;
  int step_;
};

struct Fit {
  Matrix6 curvature = Matrix6::Zero();
  Vector6 slope = Vector6::Zero();
  double cost = 0, weight = 0;
  std::size_t points = 0;

  /// A point without a surface counts as one that is far off.
  [[nodiscard]] double costOf(std::size_t all) const {
    return cost + static_cast<double>(std::max(all, points) - points);
  }
};

class MapAlignment {
 public:
  MapAlignment(const cv::Mat& measured_m, const cv::Mat& map_m, const Intrinsics& K)
      : K_(K), step_(DepthSurface(map_m, K).step()), columns_((K.width + step_ - 1) / step_) {
    const DepthSurface map(map_m, K), measured(measured_m, K);
    for (int v = 0; v < K.height; v += step_) {
      for (int u = 0; u < K.width; u += step_) {
        map_.push_back(map.at(u, v));
        const SurfacePixel pixel = measured.at(u, v);
        if (!pixel.normal.isZero()) measured_.push_back(pixel);
      }
    }
  }

  [[nodiscard]] Fit fit(const Eigen::Isometry3d& T, double gate_m) const {
    Fit fit;
    const Eigen::Isometry3f Tf = T.cast<float>();
    for (const SurfacePixel& measured : measured_) {
      const Eigen::Vector3f q = Tf * measured.point;
      const SurfacePixel* const seen = at(q);
      // The surfaces face the same way: not the two sides of a sheet, nor a table and what stands on it.
      if (seen == nullptr || seen->normal.dot(Tf.linear() * measured.normal) < 0.7F) continue;
      if ((seen->point - q).squaredNorm() > static_cast<float>(gate_m * gate_m)) continue;
      const Eigen::Vector3d n = seen->normal.cast<double>(), p = q.cast<double>();
      const double r = n.dot(seen->point.cast<double>() - p);
      // Geman-McClure: a point far off its surface counts little. Noise grows with the square of the depth.
      const double noise = kNoise_m * std::max(1.0, p.z() * p.z() / 4);
      const double s = noise * noise / (noise * noise + r * r);
      const double weight = s * s;
      Vector6 J;
      J << p.cross(n), n;
      fit.curvature += weight * J * J.transpose();
      fit.slope += weight * r * J;
      fit.cost += r * r / (noise * noise + r * r);
      fit.weight += weight;
      ++fit.points;
    }
    return fit;
  }

 private:
  /// The map's pixel where `q` is seen. Null: none with a normal.
  [[nodiscard]] const SurfacePixel* at(const Eigen::Vector3f& q) const {
    if (!(q.z() > 0)) return nullptr;
    const auto u = static_cast<int>(std::lround(q.x() / q.z() * K_.fx + K_.cx));
    const auto v = static_cast<int>(std::lround(q.y() / q.z() * K_.fy + K_.cy));
    if (!K_.isInside(u, v)) return nullptr;
    const SurfacePixel& pixel = map_[static_cast<std::size_t>((v / step_) * columns_ + u / step_)];
    return pixel.normal.isZero() ? nullptr : &pixel;
  }

  const Intrinsics& K_;
  int step_, columns_;
  std::vector<SurfacePixel> map_, measured_;
};

Eigen::Isometry3d motionOf(const Vector6& x) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d turn = x.head<3>();
  if (const double angle = turn.norm(); angle > 0)
    T.linear() = Eigen::AngleAxisd(angle, turn / angle).matrix();
  T.translation() = x.tail<3>();
  return T;
}

Vector6 parametersOf(const Eigen::Isometry3d& T) {
  const Eigen::AngleAxisd turn(T.linear());
  Vector6 x;
  x << turn.angle() * turn.axis(), T.translation();
  return x;
}

}  // namespace

std::optional<Eigen::Isometry3d> alignToMap(const cv::Mat& measured_m, const cv::Mat& map_m,
                                            const Intrinsics& K) {
  SCANTROVE_CHECK(measured_m.type() == CV_32FC1 && map_m.type() == CV_32FC1 &&
                  measured_m.size() == cv::Size(K.width, K.height) && map_m.size() == measured_m.size());
  const MapAlignment alignment(measured_m, map_m, K);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (const double gate_m : kGates_m) {
    const Fit fit = alignment.fit(T, gate_m);
    if (fit.points < kMinPoints) return std::nullopt;
    const Matrix6 curvature = fit.curvature / fit.weight + kStaying * Matrix6::Identity();
    const Vector6 slope = fit.slope / fit.weight - kStaying * parametersOf(T);
    T = motionOf(curvature.ldlt().solve(slope)) * T;
    if (!(T.translation().norm() < kMaxShift_m) || Eigen::AngleAxisd(T.linear()).angle() > kMaxTurn_rad)
      return std::nullopt;
  }
  const Fit before = alignment.fit(Eigen::Isometry3d::Identity(), kGates_m.front());
  const Fit after = alignment.fit(T, kGates_m.front());
  const std::size_t all = std::max(before.points, after.points);
  const double gain = before.costOf(all) - after.costOf(all);
  if (gain < std::max(kMinGain * before.costOf(all), kMinGainOfPoint * static_cast<double>(all)))
    return std::nullopt;
  return T;
}

}  // namespace scantrove
