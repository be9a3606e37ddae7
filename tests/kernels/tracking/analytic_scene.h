#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"

namespace scantrove::test {

struct Hit {
  double t;                ///< along the ray
  Eigen::Vector3d normal;  ///< unit, towards the ray's origin
};

/// Planes, spheres and cylinders in the world, rendered exactly (one ray through each pixel centre).
class AnalyticScene {
 public:
  using Shape =
      std::function<std::optional<Hit>(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)>;

  AnalyticScene& plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d n = normal.normalized();
    shapes_.push_back([=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) -> std::optional<Hit> {
      const double t = n.dot(point - o) / n.dot(d);
      if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
      return Hit{t, n.dot(d) < 0 ? n : Eigen::Vector3d(-n)};
    });
    return *this;
  }

  AnalyticScene& sphere(const Eigen::Vector3d& centre, double radius) {
    return quadric(Eigen::Matrix3d::Identity(), centre, radius);
  }

  AnalyticScene& cylinder(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double radius) {
    const Eigen::Vector3d a = axis.normalized();
    return quadric(Eigen::Matrix3d::Identity() - a * a.transpose(), point, radius);
  }

  [[nodiscard]] std::optional<Hit> cast(const Eigen::Vector3d& origin,
                                        const Eigen::Vector3d& direction) const {
    std::optional<Hit> nearest;
    for (const Shape& shape : shapes_) {
      const auto hit = shape(origin, direction);
      if (hit && (!nearest || hit->t < nearest->t)) nearest = hit;
    }
    return nearest;
  }

  /// Depth in units of 0.2 mm (TUM's scale; fine enough not to matter).
  [[nodiscard]] RgbdFrame frame(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera) const {
    RgbdFrame frame;
    frame.metres_per_unit = 0.0002F;
    frame.depth = cv::Mat::zeros(K.height, K.width, CV_16UC1);
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const auto hit = cast(T_world_camera.translation(), ray(K, T_world_camera, u, v));
        if (hit && hit->t < 13)
          frame.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(hit->t * 5000 + 0.5);
      }
    }
    return frame;
  }

  [[nodiscard]] SurfaceMaps maps(ComputeContext& compute, const Intrinsics& K,
                                 const Eigen::Isometry3d& T_world_camera) const {
    SurfaceMaps maps{.K = K, .T_world_camera = T_world_camera, .vertices_world = {}, .normals_world = {}};
    std::vector<cl_float4> vertices, normals;
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const Eigen::Vector3d direction = ray(K, T_world_camera, u, v);
        const auto hit = cast(T_world_camera.translation(), direction);
        vertices.push_back(hit ? element(T_world_camera.translation() + hit->t * direction) : cl_float4{});
        normals.push_back(hit ? element(hit->normal) : cl_float4{});
      }
    }
    maps.vertices_world = Buffer<cl_float4>(compute.context(), vertices.size());
    maps.normals_world = Buffer<cl_float4>(compute.context(), normals.size());
    maps.vertices_world.write(compute.queue(), vertices);
    maps.normals_world.write(compute.queue(), normals);
    return maps;
  }

 private:
  /// Direction with camera z = 1, so that t is the depth.
  static Eigen::Vector3d ray(const Intrinsics& K, const Eigen::Isometry3d& T, int u, int v) {
    return T.linear() * Eigen::Vector3d((u - static_cast<double>(K.cx)) / static_cast<double>(K.fx),
                                        (v - static_cast<double>(K.cy)) / static_cast<double>(K.fy), 1.0);
  }
  static cl_float4 element(const Eigen::Vector3d& p) {
    return {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1.0F}};
  }
  /// |A (x - centre)| = radius for a projection A; both sides of the surface are seen.
  AnalyticScene& quadric(const Eigen::Matrix3d& A, const Eigen::Vector3d& centre, double radius) {
    shapes_.push_back([=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) -> std::optional<Hit> {
      const Eigen::Vector3d p = A * (o - centre), q = A * d;
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

  std::vector<Shape> shapes_;
};

/// A corner of a room with two balls: every direction of motion is determined.
inline AnalyticScene roomCorner() {
  AnalyticScene scene;
  scene.plane({0, 0, 2.5}, {0.3, 0, -1}).plane({-1.2, 0, 0}, {1, 0, 0}).plane({0, 0.9, 0}, {0, -1, 0.1});
  scene.sphere({0.3, 0.5, 1.6}, 0.3).sphere({-0.5, -0.2, 2.0}, 0.25);
  return scene;
}

inline Eigen::Isometry3d pose(double rx_deg, double ry_deg, double rz_deg, double x, double y, double z) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = (Eigen::AngleAxisd(rz_deg * kDegree, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(ry_deg * kDegree, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(rx_deg * kDegree, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  T.translation() << x, y, z;
  return T;
}

}  // namespace scantrove::test
