#pragma once
#include "core/editing/painted_pixels.h"

namespace scantrove {

/// What a person painted in one image: which pixels are a region, and which are not.
struct MaskCorrection {
  int key_frame = 0;  ///< SavedFrame::number
  int image = 0;      ///< number of the frame in its source, as shown to users
  /// Of one size, that of the colour image (without colour: of the depth image), without common pixels.
  PaintedPixels added = {}, removed = {};
  bool this_image_only = false;  ///< leaves the regions behind the image as they are
  /// The surface behind the added pixels becomes a region of its own. The operation's region is then one
  /// that the image shows there.
  bool makes_region = false;

  bool operator==(const MaskCorrection&) const = default;
};

/// From masks of one size, CV_8UC1, nonzero = painted. A pixel of both is added.
[[nodiscard]] MaskCorrection correctionOf(const cv::Mat& added, const cv::Mat& removed);

}  // namespace scantrove
