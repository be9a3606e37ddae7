#pragma once
#include <QSqlQuery>
#include <cstdint>
#include <optional>

#include "core/editing/operation_log.h"
#include "core/session/saved_scan.h"

/// Valid ranges of a session's rows. A file may be damaged or malicious. Any thread.
namespace scantrove::rows {

/// Bounds of numbers, both inclusive.
struct Bounds {
  std::int64_t least = 0, most = 0;
};
inline constexpr Bounds kFragments{1, 0xffffff};  ///< 24 bits of a voxel's label
/// New regions and objects continue from the largest number.
inline constexpr Bounds kRegions{1, 0x7fffffff};
inline constexpr Bounds kCounts{0, 0x3fffffff};  ///< frames, voxels, operations; counting continues from them
inline constexpr Bounds kFlags{0, 1};
inline constexpr double kFarthest_m = 1e8;  ///< of any coordinate

/// None: no integer within the bounds.
[[nodiscard]] std::optional<std::int64_t> integerAt(const QSqlQuery& row, int column, Bounds bounds);
[[nodiscard]] bool areIntegers(const QSqlQuery& row, int first_column, int last_column, Bounds bounds);

/// x, y, z in metres, then the quaternion x, y, z, w. None: not finite, beyond 100,000 km, or no unit
/// quaternion.
[[nodiscard]] std::optional<Eigen::Isometry3d> poseAt(const QSqlQuery& row, int first_column);

/// Whether the camera is plausible. Its opening angle has wider limits than for a new recording.
[[nodiscard]] bool isPlausible(const Intrinsics& K);
[[nodiscard]] bool isPlausible(const SavedKeyFrame& key);
[[nodiscard]] bool isPlausible(const BorderEvidence& evidence);
/// Whether all fragment numbers, region numbers, image sizes and positions are valid.
[[nodiscard]] bool isPlausible(const Operation& operation);
[[nodiscard]] bool isPlausible(const OperationEffect& effect);

}  // namespace scantrove::rows
