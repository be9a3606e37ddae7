#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/exchange/labeled_point.h"

namespace scantrove {

// Points are relative to `origin_world`, which is added to them. Where it is not zero, x, y and z are double.

/// The bytes of such a file as writePcd() writes. VIEWPOINT is where the points were acquired from: x right,
/// y down, z forward.
[[nodiscard]] std::string encodePcd(
    std::span<const LabeledPoint> points,
    const Eigen::Isometry3d& T_world_viewpoint = Eigen::Isometry3d::Identity(),
    const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero());

/// Binary PCD with fields `x y z rgba label`; reads back as pcl::PointXYZRGBL (float). An empty cloud is a
/// valid file. Written beside and renamed. Error: names `path`.
Result<void> writePcd(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero());

/// Binary little-endian PLY with vertex properties `float x y z, uchar red green blue, uint label`.
/// Written beside and renamed. Error: names `path`.
Result<void> writePly(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero());

}  // namespace scantrove
