#include "core/fusion/sensor_fit.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

/// Focal length below which a depth sensor is coarse: a phone's LiDAR has 193 to 213, a Kinect of 320 x 240
/// pixels 262, the other sensors 365 or more.
constexpr double kCoarseFocal_px = 230;
/// A phone is carried through a room: it comes nearer to things than a far first frame says.
constexpr double kCoarseFarthest_m = 2.5;
constexpr double kUnknownDepth_m = 2.0;

/// Footprints for which voxels of FusionParams are right. A Kinect's pixel covers 1.2 mm at 0.63 m.
constexpr double kFinestFootprint_m = 0.0012, kCoarsestFootprint_m = 0.0068;
/// Sensors that are not coarse keep these voxels up to this depth, where a Kinect's pixel covers 6.8 mm.
/// Images of half its resolution show the same things, which need the same voxels.
constexpr double kUsualVoxels_m = 3.57;
/// Of scans of a chair, a board and a corridor by a phone (9.4 mm a pixel at 2 m): at 5.9 mm voxels lie
/// between the pixels and surfaces are speckled; at 15 mm each voxel has one or two readings a frame.
constexpr double kVoxelsPerFootprint = 1.5;
constexpr double kLargestVoxel_m = 0.020;

constexpr double kRangeOfDepth = 1.5;
constexpr float kFarthestRange_m = 10;
/// Nearer scenes have readings before FusionParams::min_depth_m.
constexpr double kCloseUp_m = 0.6, kNearestRange_m = 0.1;

float nearestFor(double depth_m) {
  if (depth_m >= kCloseUp_m) return FusionParams{}.min_depth_m;
  return static_cast<float>(std::max(kNearestRange_m, depth_m / 3));
}

double tenthOfMillimeter(double m) { return std::round(m * 1e4) / 1e4; }

float voxelSizeFor(const DepthSensor& sensor) {
  const float usual = FusionParams{}.voxel_size_m;
  const double footprint_m = sensor.footprint_m();
  if (footprint_m < kFinestFootprint_m) return usual / 2;
  const bool is_near = !sensor.isCoarse() && sensor.usualDepth_m() <= kUsualVoxels_m;
  if (is_near || footprint_m <= kCoarsestFootprint_m) return usual;
  return static_cast<float>(tenthOfMillimeter(std::min(kVoxelsPerFootprint * footprint_m, kLargestVoxel_m)));
}

}  // namespace

bool DepthSensor::isCoarse() const { return K.fx < kCoarseFocal_px; }

double DepthSensor::usualDepth_m() const {
  if (!median_depth_m) return kUnknownDepth_m;
  return isCoarse() ? std::min(*median_depth_m, kCoarseFarthest_m) : *median_depth_m;
}

double DepthSensor::footprint_m() const { return usualDepth_m() / static_cast<double>(K.fx); }

FusionParams fitToSensor(FusionParams params, const DepthSensor& sensor) {
  const FusionParams usual;
  const double depth_m = sensor.median_depth_m.value_or(kUnknownDepth_m);
  if (params.voxel_size_m == kAutomatic) params.voxel_size_m = voxelSizeFor(sensor);
  if (params.min_depth_m == kAutomatic) params.min_depth_m = nearestFor(depth_m);
  if (params.max_depth_m == kAutomatic) {
    const double farthest_m = sensor.isCoarse() ? usual.max_depth_m : kRangeOfDepth * depth_m;
    params.max_depth_m = std::clamp(static_cast<float>(farthest_m), usual.max_depth_m, kFarthestRange_m);
  }
  if (params.depth_noise_m == kAutomatic) params.depth_noise_m = usual.depth_noise_m;
  return params;
}

}  // namespace scantrove
