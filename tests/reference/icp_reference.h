#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

struct IcpSums {
  Eigen::Matrix<double, 6, 6> JtJ = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> Jtr = Eigen::Matrix<double, 6, 1>::Zero();
  int inliers = 0, overlap = 0, readings = 0, before = 0, behind = 0;
  double squared_error = 0, fit_weight = 0, fit_error = 0;
};

struct IcpSettings {
  double distance_m, distance_per_z2, normal_cosine, huber_m, noise_per_z2, fit_huber_m, fit_noise_per_z2;
};

/// Normal equations of point-to-plane ICP about `center`, pixel by pixel in double precision.
inline IcpSums accumulateIcp(const std::vector<Eigen::Vector4d>& vertices,
                             const std::vector<Eigen::Vector4d>& normals,
                             const Eigen::Isometry3d& T_world_frame,
                             const std::vector<Eigen::Vector4d>& model_vertices,
                             const std::vector<Eigen::Vector4d>& model_normals,
                             const Eigen::Isometry3d& T_world_model, const Intrinsics& K,
                             const Eigen::Vector3d& center, const IcpSettings& settings) {
  IcpSums sums;
  const double fx = K.fx, fy = K.fy, cx = K.cx, cy = K.cy;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].w() == 0) continue;
    ++sums.readings;
    const Eigen::Vector3d p = T_world_frame * vertices[i].head<3>();
    const Eigen::Vector3d q = T_world_model.inverse() * p;
    if (q.z() <= 0.05) continue;
    const double u = std::floor(fx * q.x() / q.z() + cx + 0.5), v = std::floor(fy * q.y() / q.z() + cy + 0.5);
    if (u < 0 || v < 0 || u >= K.width || v >= K.height) continue;
    const auto m = static_cast<std::size_t>(v * K.width + u);
    if (model_normals[m].w() == 0) continue;
    ++sums.overlap;
    const Eigen::Vector3d n = model_normals[m].head<3>(), e = model_vertices[m].head<3>() - p;
    const double z2 = vertices[i].z() * vertices[i].z();
    const double reach = settings.distance_m + settings.distance_per_z2 * z2;
    const double model_z = (T_world_model.inverse() * model_vertices[m].head<3>()).z();
    sums.before += q.z() < model_z - reach;
    sums.behind += q.z() > model_z + reach;
    if (e.norm() >= reach) continue;
    if ((T_world_frame.linear() * normals[i].head<3>()).dot(n) <= settings.normal_cosine) continue;
    const double r = n.dot(e), noise = 1 + settings.noise_per_z2 * z2, delta = settings.huber_m * noise;
    const double w = (std::abs(r) <= delta ? 1.0 : delta / std::abs(r)) / (noise * noise);
    Eigen::Matrix<double, 6, 1> J;
    J << (p - center).cross(n), n;
    sums.JtJ += w * J * J.transpose();
    sums.Jtr += w * J * r;
    const double fit_noise = 1 + settings.fit_noise_per_z2 * z2;
    const double h = std::min(1.0, settings.fit_huber_m * fit_noise / std::abs(r)) / (fit_noise * fit_noise);
    sums.fit_weight += h;
    sums.fit_error += h * r * r;
    sums.squared_error += r * r;
    ++sums.inliers;
  }
  return sums;
}

}  // namespace scantrove::reference
