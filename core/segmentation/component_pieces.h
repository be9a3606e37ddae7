#pragma once
#include <opencv2/core/mat.hpp>

#include "core/segmentation/support_finder.h"

namespace scantrove {

/// The pixels of something that stands on a support, in images of its bounding box.
struct SupportedComponent {
  cv::Mat1b mask;      ///< 255: of the component
  cv::Mat1f z_m;       ///< measured depth, 0: none
  cv::Mat1f height_m;  ///< of the measured pixels above the support
  cv::Mat1i segment;   ///< of the frame's segmentation by depth
  cv::Mat3f lab;       ///< CIE L*a*b*; empty: no colour
};

struct ComponentPieces {
  cv::Mat1i piece;     ///< 1 .. count in the mask, 0 outside
  cv::Mat1f height_m;  ///< above the support, of the measured pixel nearest to each; >= 0
  int count = 1;
};

/// Divides a component into objects that touch in the image. Its pieces are its larger segments that rise
/// from the support, and its larger flat parts that these do not enclose. Two raised pieces are one object if
/// the surface continues from one to the other without a fold, or if both together have a round outline, as
/// the inside and the outside of a cup do. A flat and a low raised piece are one if they have
/// one colour. Other pixels follow the nearest piece. `min_piece_px`: smaller segments make no piece.
[[nodiscard]] ComponentPieces divideComponent(const SupportedComponent& component, double min_piece_px,
                                              const SupportLimits& limits);

/// For each pixel of the component the nearest measured one, (-1, -1) outside or where none is measured.
[[nodiscard]] cv::Mat2i nearestMeasured(const SupportedComponent& component);

}  // namespace scantrove
