#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/exchange/coco_rle.h"

namespace scantrove {

/// The masks of one image, as another program made them; they may overlap.
struct ImageMasks {
  cv::Size size;
  std::vector<MaskRuns> masks;  ///< none is empty; each covers size.area() pixels
};

/// Builds the runs of a mask from its pixels.
class RunBuilder {
 public:
  /// Adds the pixel x * height + y; in rising order.
  void add(std::uint32_t position);
  [[nodiscard]] bool isEmpty() const { return runs_.empty(); }
  /// The runs up to the end of an image of `pixels`.
  [[nodiscard]] MaskRuns finish(std::uint32_t pixels) &&;

 private:
  MaskRuns runs_;
  std::uint32_t end_ = 0;  // after the last pixel
};

/// Each value but 0 of a label image (CV_16UC1) is a mask; in order of their values.
[[nodiscard]] ImageMasks masksOf(const cv::Mat& labels);

/// The pixels of a mask in the image scaled to `to`, which is not larger in either direction: rising indices,
/// row by row. A pixel takes the value of the nearest pixel of the mask.
[[nodiscard]] std::vector<std::uint32_t> sampledPixels(const MaskRuns& mask, const cv::Size& size,
                                                       const cv::Size& to);

}  // namespace scantrove
