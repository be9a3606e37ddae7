#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/exchange/labeled_point.h"

namespace scantrove {

// Points are relative to `origin_world`, which is added on writing. If it is not zero, x, y and z are double.

/// The bytes of writePcd()'s file. VIEWPOINT is the acquisition pose: x right, y down, z forward.
[[nodiscard]] std::string encodePcd(
    std::span<const LabeledPoint> points,
    const Eigen::Isometry3d& T_world_viewpoint = Eigen::Isometry3d::Identity(),
    const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero());

/// Default comment in the headers of clouds.
inline constexpr const char* kCloudComment = "labelled cloud: metres, label = region id";

/// Writes binary PCD with fields `x y z rgba label estimated`, readable as pcl::PointXYZRGBL (float). An
/// empty cloud is a valid file. `comment`: one line for its header. Written atomically. Error: names `path`.
Result<void> writePcd(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero(),
                      const std::string& comment = kCloudComment);

/// Writes binary little-endian PLY with vertex properties `float x y z, uchar red green blue, uint label,
/// uchar estimated`. `comment`: as for writePcd(). Written atomically. Error: names `path`.
Result<void> writePly(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world = Eigen::Vector3d::Zero(),
                      const std::string& comment = kCloudComment);

}  // namespace scantrove
