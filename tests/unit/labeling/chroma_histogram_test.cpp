#include "core/labeling/chroma_histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scantrove {
namespace {

constexpr int kSide = ChromaHistogram::kSide;
// Bin centres are 8 apart; grey lies between the centres of bins 7 (-4) and 8 (4).
int binOf(int a, int b) { return a * kSide + b; }

TEST(ChromaHistogram, ColorCountsInTheNearestBins_AtAnyBrightness) {
  ChromaHistogram histogram;
  histogram.add({90, 4, -4});
  histogram.add({10, 4, -4});
  EXPECT_FLOAT_EQ(histogram.counts()[binOf(8, 7)], 2) << "at the centre of a bin";
  histogram.add({50, 10, -2});  // three quarters of the way to 12, one quarter to 4
  EXPECT_FLOAT_EQ(histogram.counts()[binOf(9, 7)], 0.75F * 0.75F);
  EXPECT_FLOAT_EQ(histogram.counts()[binOf(9, 8)], 0.75F * 0.25F);
  EXPECT_FLOAT_EQ(histogram.counts()[binOf(8, 7)], 2 + 0.25F * 0.75F);
  EXPECT_FLOAT_EQ(histogram.counts()[binOf(8, 8)], 0.25F * 0.25F);
  EXPECT_FLOAT_EQ(histogram.counts().sum(), 3);
}

TEST(ChromaHistogram, ColorsOutsideTheRangeCountInTheLastBins) {
  ChromaHistogram histogram;
  histogram.add({50, 127, 127});
  histogram.add({50, -128, -128});
  histogram.add({50, std::numeric_limits<float>::infinity(), 0});
  EXPECT_NEAR(histogram.counts()[binOf(15, 15)], 1, 0.01F);
  EXPECT_FLOAT_EQ(histogram.counts()[binOf(0, 0)], 1);
  EXPECT_NEAR(histogram.counts().sum(), 3, 1e-5F);
}

TEST(ChromaHistogram, ChromasAreDistancesFromGray) {
  EXPECT_FLOAT_EQ(ChromaHistogram::chromas()[binOf(8, 7)], std::hypot(4.0F, 4.0F));
  EXPECT_FLOAT_EQ(ChromaHistogram::chromas()[binOf(12, 8)], std::hypot(36.0F, 4.0F));
  EXPECT_FLOAT_EQ(ChromaHistogram::chromas()[binOf(0, 15)], std::hypot(60.0F, 60.0F));
}

}  // namespace
}  // namespace scantrove
