#pragma once
#include <QSqlQuery>
#include <cstdint>
#include <optional>

#include "core/editing/operation_log.h"
#include "core/session/saved_scan.h"

/// What a row of a session can hold. A file may be damaged, or made to do harm. Any thread.
namespace scantrove::rows {

/// Bounds of numbers, both inclusive.
struct Bounds {
  std::int64_t least = 0, most = 0;
};
inline constexpr Bounds kFragments{1, 0xffffff};  ///< 24 bits of a voxel's label
/// New regions and objects are counted on from the largest one.
inline constexpr Bounds kRegions{1, 0x7fffffff};
inline constexpr Bounds kCounts{0, 0x3fffffff};  ///< frames, voxels, operations: more are counted on
inline constexpr Bounds kFlags{0, 1};
inline constexpr double kFarthest_m = 1e8;  ///< of any coordinate

/// None: the value is no integer within the bounds.
[[nodiscard]] std::optional<std::int64_t> integerAt(const QSqlQuery& row, int column, Bounds bounds);
[[nodiscard]] bool areIntegers(const QSqlQuery& row, int first_column, int last_column, Bounds bounds);

/// x, y, z in metres, then the quaternion x, y, z, w. None: no finite place within 100,000 km, or no unit
/// quaternion.
[[nodiscard]] std::optional<Eigen::Isometry3d> poseAt(const QSqlQuery& row, int first_column);

/// A camera that can exist. Its opening angle is judged more loosely than that of a new recording.
[[nodiscard]] bool isPlausible(const Intrinsics& K);
[[nodiscard]] bool isPlausible(const SavedKeyFrame& key);
[[nodiscard]] bool isPlausible(const BorderEvidence& evidence);
/// All numbers of fragments and regions, and all places, can be those of a scan.
[[nodiscard]] bool isPlausible(const Operation& operation);
[[nodiscard]] bool isPlausible(const OperationEffect& effect);

}  // namespace scantrove::rows
