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

/// What the headers of clouds say of them, where nothing else is to be said.
inline constexpr const char* kCloudComment = "labelled cloud: metres, label = region id";

/// Binary PCD with fields `x y z rgba label`; reads back as pcl::PointXYZRGBL (float). An empty cloud is a
/// valid file. `comment`: one line for its header. Written beside and renamed. Error: names `path`.
Result<void> writePcd(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero(),
                      const std::string& comment = kCloudComment);

/// Binary little-endian PLY with vertex properties `float x y z, uchar red green blue, uint label`.
/// `comment`: as of writePcd(). Written beside and renamed. Error: names `path`.
Result<void> writePly(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero(),
                      const std::string& comment = kCloudComment);

}  // namespace scantrove
