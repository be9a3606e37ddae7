#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/segmentation/inverse_depth_surface.h"
#include "core/segmentation/segment_map.h"

namespace scantrove {

/// A planar surface of one frame that carries objects: a table, a shelf, the floor.
struct Support {
  InverseDepthSurface surface;
  std::uint32_t segment = 0;  ///< the largest segment in it
  cv::Mat1b area;  ///< 255: inside the convex outline of the plane's surface; of the segments' size
  cv::Rect box;    ///< of `area`
};

/// Limits of a support, in metres at up to 1 m. They grow with the depth beyond.
struct SupportLimits {
  float flat_m = 0.009F;    ///< measured surface up to this far from the plane belongs to it
  float raised_m = 0.012F;  ///< measured surface higher than this belongs to an object
  float behind_m = 0.03F;   ///< measured surface lower than this is seen past the support's edge
  float most_m = 0.5F;      ///< what rises more stands behind or before the support rather than on it

  /// The factor of all limits but the last at depth `z_m`.
  [[nodiscard]] static float growth(float z_m) { return z_m > 1 ? z_m : 1.0F; }
};

/// The supports of a frame, from its larger planar segments that carry something: a part that rises from the
/// plane and touches it all around. Largest first. Works on every second pixel.
[[nodiscard]] std::vector<Support> findSupports(const SegmentMap& segments, const Intrinsics& K,
                                                const SupportLimits& limits = {});

}  // namespace scantrove
