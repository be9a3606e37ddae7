#include "core/evaluation/recognition_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace scantrove {
namespace {

/// Ten known pictures: eight nearest right; without their own thing all are farther.
std::vector<RecognitionTrial> trials() {
  std::vector<RecognitionTrial> all;
  for (int i = 0; i < 8; ++i) all.push_back({true, 0.1F * static_cast<float>(i + 1), 0.9F});
  all.push_back({false, 0.55F, 0.55F});
  all.push_back({false, 0.75F, 0.35F});
  return all;
}

TEST(RecognitionMetrics, CountsNearestRight) {
  EXPECT_DOUBLE_EQ(nearestRight(trials()), 0.8);
  EXPECT_EQ(nearestRight({}), 0);
}

TEST(RecognitionMetrics, CountsNamesBelowALimit) {
  const RecognitionRates rates = ratesAt(trials(), 0.6F);
  EXPECT_DOUBLE_EQ(rates.named, 0.5);
  EXPECT_DOUBLE_EQ(rates.wrong, 0.1);
  EXPECT_DOUBLE_EQ(rates.unknown_named, 0.2);
  EXPECT_EQ(ratesAt({}, 0.6F).named, 0);
}

TEST(RecognitionMetrics, LimitKeepsBothKindsOfFalseNamesRare) {
  EXPECT_EQ(limitFor(trials(), 0), 0.35F) << "an unknown thing is at 0.35";
  EXPECT_EQ(limitFor(trials(), 0.1), 0.55F) << "one unknown may be named, but not two";
  EXPECT_EQ(limitFor(trials(), 0.2), 0.9F) << "both wrong names and two unknown ones are allowed";
  EXPECT_TRUE(std::isinf(limitFor(trials(), 1)));
  for (const double most : {0.0, 0.1, 0.2}) {
    const RecognitionRates rates = ratesAt(trials(), limitFor(trials(), most));
    EXPECT_LE(rates.wrong, most);
    EXPECT_LE(rates.unknown_named, most);
  }
}

}  // namespace
}  // namespace scantrove
