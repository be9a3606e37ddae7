#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/fusion/depth_view.h"
#include "core/fusion/rendered_view.h"

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
  /// What `view` shows; one without vertices shows nothing.
  explicit KnownSurface(const RenderedView& view) : view_(view.depth()) {}

  /// Standing by pixel, CV_8UC1. `depth_noise_m`: FusionParams.
  [[nodiscard]] cv::Mat consistencies(const DepthView& now, float depth_noise_m) const;

 private:
  DepthView view_;
};

}  // namespace scantrove
