#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace scantrove {

/// Predicted and true instances of the points of one scene.
struct PointInstances {
  std::vector<std::uint32_t> predicted;  ///< by point; 0 = in no prediction
  std::vector<std::uint32_t> truth;      ///< by point, as many; 0 = void: not annotated, or no object
  std::map<std::uint32_t, double> confidence = {};  ///< of predictions; missing: the number of its points
};

/// Empty values: no true instance is large enough.
struct AveragePrecision {
  std::optional<double> ap;    ///< mean over the thresholds 0.50, 0.55, ... 0.90
  std::optional<double> ap50;  ///< at threshold 0.50
  std::optional<double> ap25;  ///< at threshold 0.25
  int instances = 0;           ///< true instances that count
  int predictions = 0;         ///< predictions of at least the minimum size, void ones too
};

/// ScanNet counts neither predictions nor true instances of fewer points.
inline constexpr int kMinInstancePoints = 100;

/// Average precision without classes over all scenes together, as in ScanNet's
/// evaluate_semantic_instance.py. A prediction matches a true instance if their intersection over union is
/// above the threshold. Each instance keeps its most confident prediction; its other ones are false. An
/// unmatched prediction is ignored if the share of its points that are void or in too small instances is
/// above the threshold; else it is false. The mean ends at 0.90, as in that script.
[[nodiscard]] AveragePrecision averagePrecision(std::span<const PointInstances> scenes,
                                                int min_points = kMinInstancePoints);

}  // namespace scantrove
