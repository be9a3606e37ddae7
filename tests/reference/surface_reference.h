#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// The plane q = a du + b dv + c of inverse depths q = 1/z around one pixel, (du, dv) the offset from it.
struct InverseDepthPlane {
  bool fits = false;
  double a = 0, b = 0, c = 0;
  double error = 0;   ///< mean squared error of q, relative to the pixel's own q^2
  double margin = 1;  ///< smallest relative distance of a neighbour from the slope limit
};

/// V_t and N_t of one view from its depths, in double precision. `depth`: width * height metres along the
/// optical axis; values not above 0 are no readings.
class SurfaceReference {
 public:
  struct Constants {
    int radius_px = 3;          ///< of the window for a plane
    double slope = 3;           ///< largest depth difference, in pixel sizes per pixel of distance
    double depth_share = 0.5;   ///< weight of the squared error at the pixel in a plane's cost
    double middle_share = 0.4;  ///< factor on the cost of the plane of the pixel itself
  };

  SurfaceReference(const Intrinsics& K, std::vector<float> depth, const Constants& constants)
      : K_(K), depth_(std::move(depth)), constants_(constants) {}

  /// Least squares over the pixels of the window whose depth differs by at most `slope` pixel sizes (z / fx
  /// along rows, z / fy along columns) per pixel of distance along either. None with fewer than five such
  /// pixels or all on one line.
  [[nodiscard]] InverseDepthPlane plane(int u, int v) const {
    InverseDepthPlane result;
    if (!has(u, v)) return result;
    const double z = at(u, v);
    std::vector<Eigen::Vector3d> rows;
    std::vector<double> readings;
    for (int dv = -constants_.radius_px; dv <= constants_.radius_px; ++dv) {
      for (int du = -constants_.radius_px; du <= constants_.radius_px; ++du) {
        if (!has(u + du, v + dv)) continue;
        const double reach =
            constants_.slope * z * std::max(std::abs(du) / double{K_.fx}, std::abs(dv) / double{K_.fy});
        const double step = std::abs(at(u + du, v + dv) - z);
        if (reach > 0) result.margin = std::min(result.margin, std::abs(step / reach - 1));
        if (step > reach) continue;
        rows.emplace_back(du, dv, 1);
        readings.push_back(1 / at(u + du, v + dv));
      }
    }
    const auto n = static_cast<Eigen::Index>(rows.size());
    if (n < 5) return result;
    Eigen::MatrixX3d A(n, 3);
    Eigen::VectorXd q(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      A.row(i) = rows[static_cast<std::size_t>(i)];
      q[i] = readings[static_cast<std::size_t>(i)];
    }
    const auto solver = A.colPivHouseholderQr();
    if (solver.rank() < 3) return result;
    const Eigen::Vector3d abc = solver.solve(q);
    result.fits = true;
    result.a = abc[0];
    result.b = abc[1];
    result.c = abc[2];
    result.error = (q - A * abc).squaredNorm() / static_cast<double>(n) * z * z;
    return result;
  }

  /// The point of a pixel, in the target frame of `T`; w = 0 if none.
  [[nodiscard]] Eigen::Vector4d vertex(int u, int v, const Eigen::Isometry3d& T) const {
    if (!has(u, v)) return Eigen::Vector4d::Zero();
    const Eigen::Vector3d p = at(u, v) * ray(u, v);
    return (T * p).homogeneous();
  }

  struct Normal {
    Eigen::Vector4d normal = Eigen::Vector4d::Zero();  ///< unit, towards the camera; w = 0: none
    double margin = 1;  ///< relative cost difference to the best different plane
  };

  /// The normal of the cheapest of the planes at (u + i, v + j), i, j in {-R, 0, R}. The cost combines the
  /// error of the plane and its error at this pixel. `planes`: width * height, row by row.
  [[nodiscard]] Normal normal(int u, int v, const std::vector<InverseDepthPlane>& planes,
                              const Eigen::Matrix3d& R_world_camera) const {
    Normal result;
    if (!has(u, v)) return result;
    double best = std::numeric_limits<double>::infinity();
    double second = best;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const int pu = u + i * constants_.radius_px, pv = v + j * constants_.radius_px;
        if (pu < 0 || pv < 0 || pu >= K_.width || pv >= K_.height) continue;
        const InverseDepthPlane& plane = planes[index(pu, pv)];
        if (!plane.fits) continue;
        const double c = plane.c + plane.a * (u - pu) + plane.b * (v - pv);  // the plane's q at this pixel
        const double miss = c * at(u, v) - 1;
        double cost = plane.error + constants_.depth_share * miss * miss;
        if (i == 0 && j == 0) cost *= constants_.middle_share;
        second = std::min(second, std::max(cost, best));
        if (cost >= best) continue;
        best = cost;
        // 1/z = m . ray with m = (a fx, b fy, c - a (u - cx) - b (v - cy)): the plane is m . p = 1.
        const Eigen::Vector3d m(plane.a * K_.fx, plane.b * K_.fy,
                                c - plane.a * (u - double{K_.cx}) - plane.b * (v - double{K_.cy}));
        result.normal << -(R_world_camera * m).normalized(), 1;
      }
    }
    if (std::isfinite(second)) result.margin = (second - best) / std::max(second, 1e-300);
    return result;
  }

  [[nodiscard]] std::size_t index(int u, int v) const { return static_cast<std::size_t>(v * K_.width + u); }

 private:
  [[nodiscard]] bool has(int u, int v) const {
    return u >= 0 && v >= 0 && u < K_.width && v < K_.height && depth_[index(u, v)] > 0;
  }
  [[nodiscard]] double at(int u, int v) const { return depth_[index(u, v)]; }
  [[nodiscard]] Eigen::Vector3d ray(int u, int v) const {
    return {(u - double{K_.cx}) / K_.fx, (v - double{K_.cy}) / K_.fy, 1};
  }

  Intrinsics K_;
  std::vector<float> depth_;
  Constants constants_;
};

}  // namespace scantrove::reference
