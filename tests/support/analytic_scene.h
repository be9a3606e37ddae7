#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::test {

/// A scene of planes, spheres, cylinders and boxes with exact depth images and normals. World frame, metres.
class AnalyticScene {
 public:
  /// First intersection of a ray: `t` along its direction, and the unit normal towards its origin.
  struct Hit {
    double t = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  /// A plane through `point`, visible from both sides.
  AnalyticScene& plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d n = normal.normalized();
    surfaces_.push_back([=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) -> std::optional<Hit> {
      const double t = (point - o).dot(n) / d.dot(n);
      if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
      return Hit{t, d.dot(n) > 0 ? Eigen::Vector3d(-n) : n};
    });
    return *this;
  }

  AnalyticScene& sphere(const Eigen::Vector3d& center, double radius) {
    return quadric(Eigen::Matrix3d::Identity(), center, radius);
  }

  AnalyticScene& cylinder(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double radius) {
    const Eigen::Vector3d a = axis.normalized();
    return quadric(Eigen::Matrix3d::Identity() - a * a.transpose(), point, radius);
  }

  /// An axis-aligned box.
  AnalyticScene& box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    surfaces_.push_back([=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) -> std::optional<Hit> {
      double enter = 0;
      double leave = std::numeric_limits<double>::infinity();
      int entered = -1;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - o[axis]) / d[axis];
        const double b = (high[axis] - o[axis]) / d[axis];
        if (std::min(a, b) > enter) {
          enter = std::min(a, b);
          entered = axis;
        }
        leave = std::min(leave, std::max(a, b));
      }
      if (entered < 0 || enter > leave) return std::nullopt;
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      normal[entered] = d[entered] > 0 ? -1 : 1;
      return Hit{enter, normal};
    });
    return *this;
  }

  [[nodiscard]] std::optional<Hit> cast(const Eigen::Vector3d& origin,
                                        const Eigen::Vector3d& direction) const {
    std::optional<Hit> first;
    for (const Surface& surface : surfaces_) {
      const std::optional<Hit> hit = surface(origin, direction);
      if (hit && (!first || hit->t < first->t)) first = hit;
    }
    return first;
  }

  /// The surface at pixel (u, v); `t` is the depth along the optical axis.
  [[nodiscard]] std::optional<Hit> seenBy(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
                                          double u, double v) const {
    return cast(T_world_camera.translation(),
                T_world_camera.linear() * Eigen::Vector3d((u - K.cx) / K.fx, (v - K.cy) / K.fy, 1));
  }

  /// width * height depths in metres, row by row, 0 without a surface.
  [[nodiscard]] std::vector<float> depth(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera) const {
    std::vector<float> result;
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const std::optional<Hit> hit = seenBy(K, T_world_camera, u, v);
        result.push_back(hit ? static_cast<float>(hit->t) : 0.0F);
      }
    }
    return result;
  }

 private:
  /// |A (x - centre)| = radius for a projection A; visible from both sides.
  AnalyticScene& quadric(const Eigen::Matrix3d& A, const Eigen::Vector3d& center, double radius) {
    surfaces_.push_back([=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) -> std::optional<Hit> {
      const Eigen::Vector3d p = A * (o - center), q = A * d;
      const double a = q.squaredNorm(), b = p.dot(q), c = p.squaredNorm() - radius * radius;
      const double root = b * b - a * c;
      if (!(root >= 0) || !(a > 0)) return std::nullopt;
      for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a}) {
        if (!(t > 0)) continue;
        const Eigen::Vector3d n = (p + t * q) / radius;
        return Hit{t, n.dot(d) < 0 ? n : Eigen::Vector3d(-n)};
      }
      return std::nullopt;
    });
    return *this;
  }

  using Surface = std::function<std::optional<Hit>(const Eigen::Vector3d&, const Eigen::Vector3d&)>;
  std::vector<Surface> surfaces_;
};

/// A camera at `eye` that looks at `target`, its y axis as close to -`up` as possible.
[[nodiscard]] inline Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                                              const Eigen::Vector3d& up = Eigen::Vector3d(0.1, 1, 0.05)) {
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = (-up).cross(z).normalized();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear().col(0) = x;
  T.linear().col(1) = z.cross(x);
  T.linear().col(2) = z;
  T.translation() = eye;
  return T;
}

/// Depth as a structured-light camera measures it: noise and quantisation of the disparity (focal length
/// times `baseline_m` over depth), eighths of a pixel.
inline void addDisparityNoise(std::vector<float>& depth_m, const Intrinsics& K, unsigned seed,
                              double baseline_m = 0.075, double sigma_px = 0.08) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_px);
  for (float& z : depth_m) {
    const double n = noise(random);
    if (!(z > 0)) continue;
    const double disparity = std::round(8.0 * (K.fx * baseline_m / z + n)) / 8.0;
    z = disparity > 1 ? static_cast<float>(K.fx * baseline_m / disparity) : 0.0F;
  }
}

}  // namespace scantrove::test
