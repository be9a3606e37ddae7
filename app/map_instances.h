#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/evaluation/average_precision.h"

namespace scantrove {

/// What becomes of points on estimated surface, which no depth reading shows.
enum class EstimatedPoints { left_out, included };

/// Region and true instance of each point of a scan's cloud.ply. The true instance is the one that most
/// frames show where the point is visible, in every tenth frame with truth. Estimated points are visible
/// where the depth image has no reading; instances that instances.json marks as no object are void. Poses are
/// those of the scan. The confidence of a region is its objectness in labels.json; no region has one if the
/// scan rated none. Empty: the scan has no cloud.ply, or the truth is no recording with depth of the frames
/// in the scan's trajectory. Error: names the damaged file.
[[nodiscard]] Result<std::optional<PointInstances>> readMapInstances(
    const std::filesystem::path& scan, const std::filesystem::path& truth,
    EstimatedPoints estimated = EstimatedPoints::left_out);

}  // namespace scantrove
