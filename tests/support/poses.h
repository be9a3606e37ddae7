#pragma once
#include <Eigen/Geometry>
#include <numbers>

namespace scantrove::test {

constexpr double kDegree = std::numbers::pi / 180;

/// Rotation Rz * Ry * Rx, and translation (x, y, z).
inline Eigen::Isometry3d pose(double rx_deg, double ry_deg, double rz_deg, double x, double y, double z) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = (Eigen::AngleAxisd(rz_deg * kDegree, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(ry_deg * kDegree, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(rx_deg * kDegree, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  T.translation() << x, y, z;
  return T;
}

}  // namespace scantrove::test
