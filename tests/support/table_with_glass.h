#pragma once
#include <opencv2/core.hpp>

#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"

namespace scantrove::test {

inline constexpr Intrinsics kOverTable{570, 570, 319.5F, 239.5F, 640, 480};
inline const cv::Rect kBoxOnTable(270, 190, 100, 100);  // rises by 8 cm
inline const cv::Rect kSheetOnTable(80, 80, 100, 70);   // of paper: has no height
inline const cv::Rect kGlassOnTable(450, 320, 60, 80);  // has no depth

/// A table from above, 1 m away, with a box, a sheet of paper and something without depth.
inline RgbdFrame tableFrame() {
  const cv::Scalar wood(90, 140, 190), paper(240, 240, 240), blue(160, 60, 40);
  RgbdFrame frame;
  frame.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(1000));
  frame.depth(kBoxOnTable).setTo(920);
  frame.depth(kGlassOnTable).setTo(0);
  frame.color = cv::Mat(480, 640, CV_8UC3, wood);
  frame.color(kBoxOnTable).setTo(cv::Scalar(60, 160, 60));
  frame.color(kSheetOnTable).setTo(paper);
  frame.color(kGlassOnTable).setTo(blue);
  return frame;
}

}  // namespace scantrove::test
