#include "core/discovery/color_histogram.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

ColorHistogram of(std::initializer_list<Eigen::Vector3f> colors) {
  ColorHistogram histogram;
  for (const Eigen::Vector3f& color : colors) histogram.add(color);
  return histogram;
}

const Eigen::Vector3f kMidGrayLab{50, 0, 0}, kOrangeLab{50, 50, 50};

TEST(ColorHistogram, IntersectionIsOne_ForEqualColorsInAnyNumber) {
  EXPECT_FLOAT_EQ(of({kMidGrayLab}).intersection(of({kMidGrayLab, kMidGrayLab, kMidGrayLab})), 1);
  EXPECT_FLOAT_EQ(of({kMidGrayLab}).intersection(of({kOrangeLab})), 0);
}

TEST(ColorHistogram, IntersectionIsTheCommonPart) {
  EXPECT_FLOAT_EQ(of({kMidGrayLab, kOrangeLab, kOrangeLab}).intersection(of({kMidGrayLab})), 1.0F / 3);
}

// Bins are 25 apart in each of L*, a* and b*: a fifth of the way leaves four fifths in the bin.
TEST(ColorHistogram, IntersectionIsHigh_ForSimilarColors) {
  EXPECT_NEAR(of({kMidGrayLab}).intersection(of({{55, 0, 0}})), 0.8, 1e-4);
  EXPECT_NEAR(of({kMidGrayLab}).intersection(of({{55, 0, -5}})), 0.64, 1e-4);
}

TEST(ColorHistogram, ColorsOutsideTheRangeCountInTheLastBins) {
  EXPECT_NEAR(of({{50, 80, 0}}).intersection(of({{50, 50, 0}})), 1, 1e-3);
}

TEST(ColorHistogram, AddSumsColors) {
  ColorHistogram sum = of({kMidGrayLab});
  sum.add(of({kOrangeLab}));
  EXPECT_FLOAT_EQ(sum.intersection(of({kMidGrayLab, kOrangeLab})), 1);
}

TEST(ColorHistogram, IsRestoredFromItsShares) {
  const ColorHistogram some = of({kMidGrayLab, kOrangeLab, {70, 3, -8}});
  EXPECT_NEAR(ColorHistogram::ofShares(some.shares()).intersection(some), 1, 1e-6);
  EXPECT_TRUE(ColorHistogram::ofShares(ColorHistogram().shares()).isEmpty());
}

TEST(ColorHistogram, IntersectionIsZero_WhenOneIsEmpty) {
  EXPECT_TRUE(ColorHistogram().isEmpty());
  EXPECT_EQ(ColorHistogram().intersection(of({kMidGrayLab})), 0);
  EXPECT_EQ(of({kMidGrayLab}).intersection(ColorHistogram()), 0);
}

}  // namespace
}  // namespace scantrove
