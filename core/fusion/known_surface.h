#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "core/compute/compute_context.h"
#include "core/fusion/depth_view.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// How a reading stands to the map's surface.
enum class DepthConsistency : std::uint8_t {
  none,     ///< there is no reading
  unknown,  ///< nothing is known there
  fits,     ///< it is on the surface, or near it
  before,   ///< the surface lies behind it: something is in front
  behind    ///< it was seen through the surface: that has gone
};

/// The map's surface as it was seen last, on the host. Immutable; any thread.
class KnownSurface {
 public:
  /// Nothing is known.
  KnownSurface() = default;
  /// `vertices_world`: K.pixels(), with w = 0 where there is no surface.
  KnownSurface(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
               std::span<const Eigen::Vector4f> vertices_world);
  /// Reads `surface` from the device; one without buffers shows nothing.
  KnownSurface(ComputeContext& compute, const SurfaceMaps& surface);

  /// Standing by pixel, CV_8UC1. `depth_noise_m`: FusionParams.
  [[nodiscard]] cv::Mat consistencies(const DepthView& now, float depth_noise_m) const;

 private:
  DepthView view_;
};

}  // namespace scantrove
