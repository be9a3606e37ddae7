#pragma once
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/segmentation/segment_map.h"
#include "core/segmentation/support_colors.h"
#include "core/segmentation/support_finder.h"

namespace scantrove {

/// Images of one support, in its box. Masks are 0 or 255.
struct SupportImages {
  cv::Rect box;       ///< in the image of the frame
  cv::Mat1b area;     ///< of the support
  cv::Mat1b flat;     ///< measured surface in the plane
  cv::Mat1b raised;   ///< measured surface above it, as high as objects on it may be
  cv::Mat1b tall;     ///< of `raised`: high enough to cast a wide shadow
  cv::Mat1b missing;  ///< no depth
  cv::Mat1f height_m;
  SupportColorDifference difference;

  /// `lab`: of the frame, empty without colour.
  [[nodiscard]] static SupportImages of(const Support& support, const SegmentMap& segments,
                                        const cv::Mat3f& lab, const Intrinsics& K);
};

/// Connected pixels that stand out from a support by height or colour, and are objects on it.
struct Component {
  int label = 0;  ///< in the image of labels
  cv::Rect box;   ///< in that of the support
  int area_px = 0, raised_px = 0, measured_px = 0;

  /// Its height speaks for it, not only its colour.
  [[nodiscard]] bool isRaised() const;
  /// It has depth nearly everywhere.
  [[nodiscard]] bool isComplete() const;
};

struct SupportComponents {
  cv::Mat1i labels;  ///< in the support's box
  std::vector<Component> components;
};

/// `others`: 255 on the segments of other supports, which are no objects. `K`: of the frame.
[[nodiscard]] SupportComponents findComponents(const SupportImages& images, const cv::Mat1b& others,
                                               const Intrinsics& K);

}  // namespace scantrove
