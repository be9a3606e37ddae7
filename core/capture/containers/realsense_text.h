#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "core/capture/containers/ros_messages.h"

namespace scantrove {

// RealSense's SDK writes its .db3 recordings (since 2026) with texts instead of messages:
// KEY=VALUE;KEY=VALUE.

/// The value of a key; empty: none.
[[nodiscard]] std::string realsenseValue(const std::string& text, const std::string& key);
/// "width=640;height=480;fx=...;ppx=...;fy=...;ppy=...;model=...;coeffs=...". None: damaged.
[[nodiscard]] std::optional<RosCameraInfo> realsenseCameraInfo(const std::string& text);
/// "rotation=" with 9 numbers, column by column, ";translation=" with 3, metres. None: damaged.
[[nodiscard]] std::optional<Eigen::Isometry3d> realsenseTransform(const std::string& text);

}  // namespace scantrove
