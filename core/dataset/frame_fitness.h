#pragma once
#include <array>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/dataset/depth_shift.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// Finds frames that are unfit for a data set: those too blurred, or whose depth and colour do not fit.
/// Sharpness is compared between frames, so a scan that is blurred throughout loses none.
class FrameFitness {
 public:
  /// Frames with colour, in order of time. Images as in DepthShift.
  void add(const KeyFrameInfo& frame, const cv::Mat& depth, const cv::Mat& color);

  /// Why frames are unfit, by KeyFrameInfo::index, as the end of a sentence.
  ///
  /// A frame is too blurred if its surface is less than a quarter as sharp as in the sharpest frame that
  /// shows it from a similar distance, by the median of squares of the image. If too little of its surface is
  /// shown by others, it is compared with the frames before and after it.
  ///
  /// Depth and colour do not fit if their edges are more than 4 pixels (of an image 640 wide) apart. An
  /// offset that most frames have up to that distance belongs to the calibration.
  [[nodiscard]] std::map<int, std::string> unfit() const;

 private:
  /// A square of an image with enough contrast.
  struct Square {
    std::array<int, 3> cell{};  ///< its place in the world, in cells of a grid
    float z_m = 0;              ///< 0: unknown, and so is the place
    float sharpness = 0;
  };
  struct Frame {
    int index = 0;
    std::vector<Square> squares;
    DepthShift shift;
  };

  [[nodiscard]] static std::vector<Square> squaresOf(const KeyFrameInfo& frame, const cv::Mat& depth,
                                                     const cv::Mat& color);
  [[nodiscard]] cv::Point2f usualShift() const;
  /// Sharpness relative to other views of the same surface, by frame; none: too little is shared.
  [[nodiscard]] std::vector<std::optional<float>> sharpnessOnSurface() const;
  /// Sharpness relative to the frames around, by frame; none: unknown.
  [[nodiscard]] std::vector<std::optional<float>> sharpnessAmongNeighbors() const;

  std::vector<Frame> frames_;
};

}  // namespace scantrove
