#include "core/catalogue/match_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace scantrove {
namespace {

TEST(MatchDistance, IsZero_WhenNothingDiffers) {
  EXPECT_EQ(matchDistance({0, 0, 0.0F, 0, 0.0F}), 0);
  EXPECT_EQ(matchDistance({0, 0, {}, 0, {}}), 0);
}

TEST(MatchDistance, GrowsWithEachDifference) {
  const ViewDifference usual{0.5F, 0.1F, 0.2F, 0.1F, 0.3F};
  const auto grown = [&](auto change) {
    ViewDifference difference = usual;
    change(difference);
    return matchDistance(difference) - matchDistance(usual);
  };
  EXPECT_GT(grown([](ViewDifference& d) { d.shape += 0.1F; }), 0);
  EXPECT_GT(grown([](ViewDifference& d) { *d.colors += 0.1F; }), 0);
  EXPECT_GT(grown([](ViewDifference& d) { d.size += 0.1F; }), 0);
  EXPECT_GT(grown([](ViewDifference& d) { *d.network += 0.1F; }), 0);
  EXPECT_EQ(grown([](ViewDifference& d) { d.mean_color += 0.1F; }), 0) << "the histogram says it better";
}

TEST(MatchDistance, UsesTheMeanColor_WhenAViewHasNoHistogram) {
  EXPECT_FLOAT_EQ(matchDistance({0.5F, 0.1F, {}, 0, {}}), 0.6F);
}

TEST(ThumbnailDistance, IsThatOfShapeAndMeanColor) {
  EXPECT_FLOAT_EQ(thumbnailDistance({0.5F, 0.1F, 0.9F, 2, 0.9F}), 0.6F);
}

TEST(MatchDistance, SizeIsEvidence) {
  const Eigen::Vector3f size_m(0.3F, 0.2F, 0.1F);
  const auto ofRatio = [&](float ratio) {
    return matchDistance({0, 0, 0.0F, sizeDifference(size_m, ratio * size_m), {}});
  };
  EXPECT_LT(ofRatio(1.3F), 0.1F);
  EXPECT_GT(ofRatio(1.5F), ofRatio(1.3F));
  EXPECT_LT(ofRatio(2), 0.5F) << "sizes in single photographs differ so much";
  EXPECT_GT(ofRatio(3), 0.5F) << "a copy of three times the size is another object";
}

TEST(SizeDifference, IsTheMeanOfDiagonalAndSides) {
  const Eigen::Vector3f a(0.4F, 0.2F, 0.1F), b(0.2F, 0.2F, 0.05F);
  const double diagonals = std::log(std::sqrt(0.21) / std::sqrt(0.0825));
  const double sides = (std::log(2.0) + 0 + std::log(2.0)) / 3;
  EXPECT_NEAR(sizeDifference(a, b), (diagonals + sides) / 2, 1e-6);
  EXPECT_FLOAT_EQ(sizeDifference(b, a), sizeDifference(a, b));
  EXPECT_EQ(sizeDifference(a, Eigen::Vector3f::Zero()), 0) << "unknown";
  const Eigen::Vector3f thin(0.2F, 0.02F, 0.001F), thinner(0.2F, 0.01F, 0.002F);
  EXPECT_LT(sizeDifference(thin, thinner), 0.005F) << "sides of a pen are noise";
}

TEST(ObjectDistance, IsMostlyThatOfTheNearestView) {
  EXPECT_FLOAT_EQ(objectDistance({0.4F}), 0.4F);
  EXPECT_FLOAT_EQ(objectDistance({0.8F, 0.4F}), 0.8F * 0.4F + 0.2F * 0.6F);
  EXPECT_FLOAT_EQ(objectDistance({1.5F, 0.9F, 0.3F, 0.6F}), 0.8F * 0.3F + 0.2F * 0.6F) << "of three views";
}

/// distance / sqrt(mean of the five nearest others).
float expectedOf(float distance, const std::vector<float>& five) {
  return distance / std::sqrt(std::accumulate(five.begin(), five.end(), 0.0F) / 5);
}

TEST(RelativeDistance, ComparesWithTheFiveNearestOthers) {
  const std::vector<float> others{0.9F, 3, 0.5F, 0.8F, 2, 0.6F, 0.7F, 1.5F, 1.2F};
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, others, 10), expectedOf(0.3F, {0.5F, 0.6F, 0.7F, 0.8F, 0.9F}));
  EXPECT_LT(relativeDistance(0.3F, std::vector<float>(9, 1.4F), 10), 0.3F) << "nothing else is near";
  EXPECT_GT(relativeDistance(0.3F, std::vector<float>(9, 0.4F), 10), 0.3F) << "all are as near";
}

TEST(RelativeDistance, CompletesASmallCatalogueByUsualObjects) {
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, {}, 1), 0.3F) << "nothing to compare with";
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, {2.5F}, 2), 0.3F) << "a far object does not make it surer";
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, {0.4F}, 2), expectedOf(0.3F, {0.4F, 1, 1, 1, 1}));
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, std::vector<float>(8, 1.5F), 9),
                  expectedOf(0.3F, {1, 1.5F, 1.5F, 1.5F, 1.5F}));
}

TEST(RelativeDistance, UsesTheComparedObjects_WhenMoreAreInTheCatalogue) {
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, {0.5F, 0.7F}, 10), 0.3F / std::sqrt(0.6F));
  EXPECT_FLOAT_EQ(relativeDistance(0.3F, {}, 40), 0.3F);
}

TEST(RelativeDistance, IsNotSurer_WhenOthersDifferBySizeToo) {
  const float unrelated = relativeDistance(0.9F, std::vector<float>(9, 2), 10);
  EXPECT_EQ(relativeDistance(0.9F, std::vector<float>(9, 40), 10), unrelated);
  EXPECT_EQ(relativeDistance(0.9F, std::vector<float>(9, std::numeric_limits<float>::infinity()), 10),
            unrelated);
  EXPECT_GT(unrelated, 0.5F);
}

TEST(RelativeDistance, StaysFinite_WhenDuplicatesAreInTheCatalogue) {
  EXPECT_TRUE(std::isfinite(relativeDistance(0.1F, std::vector<float>(9, 0.0F), 10)));
}

}  // namespace
}  // namespace scantrove
