#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// The plane of the window around one pixel, fitted to inverse depth in double precision.
struct WindowPlane {
  bool fits = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< camera frame, towards the camera
  double rms_m = 0;                                  ///< distance of the readings from the plane
  double concavity_m = 0;                            ///< rise of the border above the middle
  double margin = 1;  ///< smallest relative distance of a reading from the gate; below ~1e-4 float rounding
                      ///< may decide otherwise
};

/// The formula of refine_normals.cl. `z`: width * height depths, 0 = none.
class NormalReference {
 public:
  NormalReference(const Intrinsics& K, std::vector<double> z, int radius, double gate_m)
      : K_(K), z_(std::move(z)), radius_(radius), gate_m_(gate_m) {
    planes_.reserve(z_.size());  // computed once, because each pixel uses the planes of its neighbours
    for (int y = 0; y < K_.height; ++y) {
      for (int x = 0; x < K_.width; ++x) planes_.push_back(fit(x, y));
    }
  }

  [[nodiscard]] bool sameSurface(int x, int y, int x2, int y2, double* margin = nullptr) const {
    if (x2 < 0 || y2 < 0 || x2 >= K_.width || y2 >= K_.height || !(at(x2, y2) > 0)) return false;
    const double z = at(x, y);
    const double reach = gate_m_ * std::max(1.0, z * z) / (z * z);
    const double step = std::abs(1 / at(x2, y2) - 1 / z);
    if (margin != nullptr) *margin = std::min(*margin, std::abs(step / reach - 1));
    return step <= reach;
  }

  [[nodiscard]] const WindowPlane& plane(int x, int y) const { return planes_[index(x, y)]; }

 private:
  [[nodiscard]] WindowPlane fit(int x, int y) const {
    WindowPlane result;
    if (!(at(x, y) > 0)) return result;
    std::vector<Eigen::Vector3d> rows;  // (dx, dy, 1)
    std::vector<double> readings;
    for (int dy = -radius_; dy <= radius_; ++dy) {
      for (int dx = -radius_; dx <= radius_; ++dx) {
        if (!sameSurface(x, y, x + dx, y + dy, &result.margin)) continue;
        rows.emplace_back(dx, dy, 1);
        readings.push_back(1 / at(x + dx, y + dy));
      }
    }
    const auto n = static_cast<Eigen::Index>(rows.size());
    if (n < 5) return result;
    Eigen::MatrixX3d A(n, 3);
    Eigen::VectorXd b(n), r(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      A.row(i) = rows[static_cast<std::size_t>(i)];
      b[i] = readings[static_cast<std::size_t>(i)];
      r[i] = A(i, 0) * A(i, 0) + A(i, 1) * A(i, 1);
    }
    const auto solver = A.colPivHouseholderQr();
    if (solver.rank() < 3) return result;
    const Eigen::Vector3d abc = solver.solve(b);
    const Eigen::VectorXd residuals = b - A * abc;
    const Eigen::Vector3d m(
        abc[0] * K_.fx, abc[1] * K_.fy,
        abc[2] + abc[0] * (K_.cx - static_cast<float>(x)) + abc[1] * (K_.cy - static_cast<float>(y)));
    const double to_meters = at(x, y) / m.norm();
    const Eigen::VectorXd centered = r.array() - r.mean();
    const double spread = centered.squaredNorm();
    result.fits = true;
    result.normal = -m.normalized();
    result.rms_m = std::sqrt(residuals.squaredNorm() / static_cast<double>(n)) * to_meters;
    result.concavity_m = spread > 0 ? centered.dot(residuals) / spread * radius_ * radius_ * to_meters : 0;
    return result;
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * K_.width + x); }
  double at(int x, int y) const { return z_[index(x, y)]; }

  Intrinsics K_;
  std::vector<double> z_;
  int radius_;
  double gate_m_;
  std::vector<WindowPlane> planes_;
};

}  // namespace scantrove::reference
