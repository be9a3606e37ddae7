#pragma once
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/capture/json_file.h"

namespace scantrove {

// What the files of phones say about a frame. ARKit and OpenGL: the camera's x axis points right, y up, z
// backward. Scantrove and OpenCV: x right, y down, z forward.

/// The finite numbers of `object[key]`: a number, or an array of them, or of arrays (row by row). Empty:
/// missing, not `count` finite numbers, or no object.
[[nodiscard]] std::optional<std::vector<double>> numbersOf(const nlohmann::json& object, const char* key,
                                                           std::size_t count);

/// The same for a value.
[[nodiscard]] std::optional<std::vector<double>> numbersIn(const nlohmann::json& value, std::size_t count);

/// The finite number `object[key]`; empty if there is none.
[[nodiscard]] std::optional<double> numberOf(const nlohmann::json& object, const char* key);

/// The positive whole number `object[key]`, at most 8192 (a side of an image); empty if there is none.
[[nodiscard]] std::optional<int> sideOf(const nlohmann::json& object, const char* key);

/// The text `object[key]`; empty if there is none.
[[nodiscard]] std::string textOf(const nlohmann::json& object, const char* key);

/// A pose from sixteen numbers, row by row. Empty: no rigid motion.
[[nodiscard]] std::optional<Eigen::Isometry3d> poseFromRows(std::span<const double> matrix);

/// A pose from a quaternion and a place: qx qy qz qw px py pz. Empty: not finite, or a quaternion far from a
/// unit one.
[[nodiscard]] std::optional<Eigen::Isometry3d> poseFromQuaternion(std::span<const double> values);

/// T_world_camera with Scantrove's camera axes, from one with ARKit's. Empty stays empty.
[[nodiscard]] std::optional<Eigen::Isometry3d> fromArkitAxes(const std::optional<Eigen::Isometry3d>& pose);

/// fx, fy, cx, cy of a 3x3 camera matrix, row by row, for images of `width` x `height`.
[[nodiscard]] Intrinsics intrinsicsFromRows(std::span<const double> matrix, int width, int height);

/// The same for a matrix that is stored column by column.
[[nodiscard]] Intrinsics intrinsicsFromColumns(std::span<const double> matrix, int width, int height);

}  // namespace scantrove
