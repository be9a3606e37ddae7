#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/fusion/depth_view.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Consistency of a reading with the map's surface.
enum class DepthConsistency : std::uint8_t {
  none,     ///< no reading
  unknown,  ///< the map has no surface there
  fits,     ///< on or near the surface
  before,   ///< in front of the surface, which is occluded
  behind    ///< behind the surface, which has gone
};

/// The map's surface in its last rendered view, on the host. Immutable; any thread.
class KnownSurface {
 public:
  /// Without surface.
  KnownSurface() = default;
  /// The surface of `view`; none if it has no vertices.
  explicit KnownSurface(const RenderedView& view) : view_(view.depth()) {}

  /// DepthConsistency by pixel, CV_8UC1. `depth_noise_m`: FusionParams.
  [[nodiscard]] cv::Mat consistencies(const DepthView& now, float depth_noise_m) const;

 private:
  DepthView view_;
};

}  // namespace scantrove
