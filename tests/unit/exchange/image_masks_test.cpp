#include "core/exchange/image_masks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The mask of a run-length code, CV_8UC1.
cv::Mat maskFrom(const MaskRuns& runs, const cv::Size& size) {
  cv::Mat columns(size.width, size.height, CV_8UC1, cv::Scalar(0));
  std::size_t position = 0;
  for (std::size_t run = 0; run < runs.size(); position += runs[run++]) {
    if (run % 2 == 1) std::fill_n(columns.data + position, runs[run], std::uint8_t{255});
  }
  return columns.t();
}

TEST(ImageMasks, EachValueOfALabelImageIsAMask) {
  const cv::Mat labels = (cv::Mat_<std::uint16_t>(2, 4) << 0, 7, 7, 300,  //
                          0, 7, 300, 300);
  const ImageMasks image = masksOf(labels);
  EXPECT_EQ(image.size, cv::Size(4, 2));
  ASSERT_EQ(image.masks.size(), 2U);
  for (const auto& [place, label] : {std::pair(0, 7), std::pair(1, 300)}) {
    const cv::Mat expected = labels == label;
    const cv::Mat mask = maskFrom(image.masks[static_cast<std::size_t>(place)], image.size);
    EXPECT_EQ(cv::countNonZero(mask != expected), 0) << label;
  }
}

TEST(ImageMasks, LabelImageWithoutLabelsHasNoMask) {
  EXPECT_THAT(masksOf(cv::Mat::zeros(3, 5, CV_16UC1)).masks, IsEmpty());
}

TEST(ImageMasks, BuilderMergesNeighboringPixels) {
  RunBuilder builder;
  for (const std::uint32_t position : {2U, 3U, 4U, 6U}) builder.add(position);
  EXPECT_THAT(std::move(builder).finish(9), ElementsAre(2, 3, 1, 1, 2));
  RunBuilder from_first;
  from_first.add(0);
  EXPECT_THAT(std::move(from_first).finish(1), ElementsAre(0, 1)) << "runs begin outside";
  EXPECT_THAT(RunBuilder().finish(4), ElementsAre(4));
}

TEST(ImageMasks, SamplesAtFullSizeAreAllPixels) {
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(2, 3) << 0, 1, 1,  //
                        1, 0, 1);
  EXPECT_THAT(sampledPixels(runsOf(mask), {3, 2}, {3, 2}), ElementsAre(1, 2, 3, 5));
}

// With 6 columns for 3, column 0 takes the value of column 1, column 1 that of 3, column 2 that of 5.
TEST(ImageMasks, SmallerImageTakesTheNearestPixels) {
  cv::Mat mask = cv::Mat::zeros(4, 6, CV_8UC1);
  mask.col(3) = 1;
  EXPECT_THAT(sampledPixels(runsOf(mask), {6, 4}, {3, 2}), ElementsAre(1, 4));
  mask = 0;
  mask.col(2) = 1;
  EXPECT_THAT(sampledPixels(runsOf(mask), {6, 4}, {3, 2}), IsEmpty());
}

}  // namespace
}  // namespace scantrove
