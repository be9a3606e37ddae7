#pragma once
#include <optional>

#include "core/capture/intrinsics.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// A depth sensor and its distance from the scene.
struct DepthSensor {
  Intrinsics K;                          ///< of its depth images as they are stored
  std::optional<double> median_depth_m;  ///< of the first frame; none: it has no readings, or is not known

  /// Whether its pixels are as coarse as those of a phone's LiDAR (256 x 192).
  [[nodiscard]] bool isCoarse() const;
  /// Distance for which the map is made: the median depth, for a coarse sensor at most 2.5 m; 2 m if not
  /// known.
  [[nodiscard]] double usualDepth_m() const;
  /// Width of the surface that a pixel covers at usualDepth_m(), seen straight on.
  [[nodiscard]] double footprint_m() const;
};

/// Replaces parameters that are kAutomatic by those that fit the sensor; all others stay. A Kinect 0.7 to 3.5
/// m from the scene gets the defaults of FusionParams.
/// - Voxels are smaller where several pixels fall into one, and larger where pixels fall between them:
///   half as large below 1.2 mm of footprint, 1.5 footprints (at most 20 mm) above 6.8 mm. Sensors that are
///   not coarse keep the usual voxels up to 3.57 m, whatever their resolution.
/// - The range ends at 1.5 times the median depth, within 5 and 10 m; that of a coarse sensor at 5 m.
/// - It begins at 0.3 m, in close-ups (below 0.6 m) at a third of the median depth.
[[nodiscard]] FusionParams fitToSensor(FusionParams params, const DepthSensor& sensor);

}  // namespace scantrove
