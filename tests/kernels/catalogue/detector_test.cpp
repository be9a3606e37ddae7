#include "core/catalogue/detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <optional>

namespace scantrove {
namespace {

const Eigen::Vector3f kSize(0.2F, 0.15F, 0.1F);

/// A picture of coloured patches on an ellipse, another for each seed, with noise of a camera and `scene`
/// behind it.
struct Look {
  cv::Mat color, mask;
  Look(int seed, const cv::Size& size, int scene) {
    cv::RNG random(static_cast<std::uint64_t>(seed) * 7919 + 1),
        noise(static_cast<std::uint64_t>(scene) + 99);
    cv::Mat patches(4, 4, CV_8UC3);
    random.fill(patches, cv::RNG::UNIFORM, 20, 236);
    cv::resize(patches, color, size, 0, 0, cv::INTER_CUBIC);
    mask = cv::Mat(size, CV_8UC1, cv::Scalar(0));
    cv::ellipse(mask, {size.width / 2, size.height / 2}, {size.width / 2 - 1, size.height / 2 - 1}, 0, 0, 360,
                255, cv::FILLED);
    cv::Mat grain(size, CV_8UC3);
    noise.fill(grain, cv::RNG::UNIFORM, 0, 10);
    color += grain;
    color.setTo(cv::Scalar(noise.uniform(0, 255), noise.uniform(0, 255), noise.uniform(0, 255)), mask == 0);
  }
  [[nodiscard]] DetectionQuery query(const Eigen::Vector3f& size_m = kSize) const {
    return {color, mask, size_m};
  }
};

class DetectorTest : public testing::Test {
 protected:
  void SetUp() override {
    auto compute = ComputeContext::create({});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
    auto detector = Detector::create(*compute_);
    ASSERT_TRUE(detector) << detector.error().message();
    detector_.emplace(std::move(*detector));
  }
  /// Object seed + 1, holding itself.
  void addObject(int seed) {
    const Look look(seed, {90, 70}, 0);
    const ObjectId object{static_cast<std::uint32_t>(seed + 1)};
    detector_->add({seed + 1, object, kSize, makeThumbnail(look.color, look.mask).value()});
    detector_->setMergeRoot({object, object});
  }
  std::uint32_t find(const DetectionQuery& query) { return detector_->find({query})[0].object.value; }

  std::unique_ptr<ComputeContext> compute_;
  std::optional<Detector> detector_;
};

TEST_F(DetectorTest, AnEmptyCatalogueKnowsNothing) {
  EXPECT_EQ(detector_->viewCount(), 0);
  EXPECT_FALSE(detector_->find({Look(0, {90, 70}, 0).query()})[0].object);
  EXPECT_TRUE(detector_->find({}).empty());
}

TEST_F(DetectorTest, RecognizesAtAnotherSizeBeforeAnotherBackground) {
  for (int seed = 0; seed < 20; ++seed) addObject(seed);
  std::vector<DetectionQuery> queries;
  for (int seed = 0; seed < 20; ++seed) queries.push_back(Look(seed, {61, 50}, seed + 1).query());
  for (int seed = 20; seed < 40; ++seed) queries.push_back(Look(seed, {61, 50}, seed + 1).query());
  const std::vector<DetectionMatch> matches = detector_->find(queries);
  ASSERT_EQ(matches.size(), 40U);
  for (std::uint32_t i = 0; i < 20; ++i) {
    EXPECT_EQ(matches[i].object.value, i + 1) << matches[i].distance;
    EXPECT_LT(matches[i].distance, 0.15F);
  }
  for (std::size_t i = 20; i < 40; ++i) EXPECT_FALSE(matches[i].object) << i << " " << matches[i].distance;
}

TEST_F(DetectorTest, WarmingUpLeavesTheCatalogueAsItIs) {
  detector_->warmUp();
  EXPECT_FALSE(detector_->find({Look(0, {90, 70}, 0).query()})[0].object) << "still empty";
  for (int seed = 0; seed < 3; ++seed) addObject(seed);
  detector_->warmUp();
  EXPECT_EQ(detector_->viewCount(), 3);
  for (int seed = 0; seed < 3; ++seed)
    EXPECT_EQ(find(Look(seed, {61, 50}, 9).query()), static_cast<std::uint32_t>(seed + 1));
}

TEST_F(DetectorTest, FindsAmongManyAfterPruning) {
  for (int seed = 0; seed < 400; ++seed) addObject(seed);
  EXPECT_EQ(detector_->viewCount(), 400);
  int found = 0;
  for (int seed = 0; seed < 400; seed += 8) {
    found += find(Look(seed, {75, 64}, seed).query()) == static_cast<std::uint32_t>(seed + 1) ? 1 : 0;
  }
  EXPECT_GE(found, 49);  // of 50
}

TEST_F(DetectorTest, WhatIsAddedIsFoundAtOnce) {
  for (int seed = 0; seed < 5; ++seed) addObject(seed);
  EXPECT_EQ(find(Look(4, {90, 70}, 1).query()), 5U);
  EXPECT_EQ(find(Look(5, {90, 70}, 1).query()), 0U);
  addObject(5);
  EXPECT_EQ(find(Look(5, {90, 70}, 1).query()), 6U);
}

// Merging, deleting and undoing either move no view: only who holds it changes.
TEST_F(DetectorTest, AMatchIsWhoHoldsTheViewNow) {
  for (int seed = 0; seed < 5; ++seed) addObject(seed);
  const DetectionQuery query = Look(4, {90, 70}, 1).query();
  detector_->setMergeRoot({ObjectId{5}, ObjectId{2}});
  EXPECT_EQ(find(query), 2U);
  EXPECT_EQ(detector_->mergeRootOf(ObjectId{5}), ObjectId{2});
  detector_->setMergeRoot({ObjectId{5}, {}});
  EXPECT_EQ(find(query), 0U);
  EXPECT_EQ(find(Look(0, {90, 70}, 1).query()), 1U);
  detector_->setMergeRoot({ObjectId{5}, ObjectId{5}});
  EXPECT_EQ(find(query), 5U);
  EXPECT_FALSE(detector_->mergeRootOf(ObjectId{99}));
  EXPECT_EQ(detector_->viewCount(), 5);
}

TEST_F(DetectorTest, AnotherSizeIsAnotherObject) {
  addObject(0);
  EXPECT_EQ(find(Look(0, {90, 70}, 1).query(1.3F * kSize)), 1U);
  EXPECT_EQ(find(Look(0, {90, 70}, 1).query(3 * kSize)), 0U);
  EXPECT_EQ(find(Look(0, {90, 70}, 1).query(Eigen::Vector3f::Zero())), 1U);  // unknown size
}

TEST_F(DetectorTest, AnotherColorIsAnotherObject) {
  addObject(0);
  Look painted(0, {90, 70}, 1);
  painted.color += cv::Scalar(0, 0, 90);
  EXPECT_EQ(find(painted.query()), 0U);
}

TEST_F(DetectorTest, SaysWhatIsNearestWhereThatIsNotNearEnough) {
  addObject(0);
  Look worn(0, {90, 70}, 1);
  cv::addWeighted(worn.color, 0.4, Look(1, {90, 70}, 1).color, 0.6, 0, worn.color);
  const DetectionMatch match = detector_->find({worn.query()})[0];
  EXPECT_FALSE(match.object);
  EXPECT_EQ(match.nearest, ObjectId{1});
  EXPECT_FALSE(detector_->find({worn.query(3 * kSize)})[0].nearest) << "nothing is so large";
}

TEST_F(DetectorTest, WhatMayBeMissingIsComparedThoughOnlyHalfOfItIsKnown) {
  for (int seed = 0; seed < 3; ++seed) addObject(seed);
  DetectionQuery half = Look(1, {90, 70}, 1).query(0.55F * kSize);
  EXPECT_FALSE(detector_->find({half})[0].guess) << "nothing is missing";
  half.guesses = {ObjectId{1}, ObjectId{2}};
  const DetectionMatch match = detector_->find({half})[0];
  EXPECT_EQ(match.guess, ObjectId{2});
  EXPECT_LT(match.guess_distance, 0.15F);
  EXPECT_FALSE(match.nearest) << "nothing is so small";
  half.size_m = 0.4F * kSize;
  EXPECT_FALSE(detector_->find({half})[0].guess) << "less than half";
  half.size_m = 1.6F * kSize;
  EXPECT_FALSE(detector_->find({half})[0].guess) << "larger than the whole";
}

TEST_F(DetectorTest, WhatIsMissingChangesNothingOfWhatIsRecognized) {
  for (int seed = 0; seed < 3; ++seed) addObject(seed);
  DetectionQuery query = Look(1, {90, 70}, 1).query();
  query.guesses = {ObjectId{1}};
  const DetectionMatch match = detector_->find({query})[0];
  EXPECT_EQ(match.object, ObjectId{2});
  EXPECT_EQ(match.nearest, ObjectId{2});
}

TEST_F(DetectorTest, WithoutColorOrPixelsNothingIsKnown) {
  addObject(0);
  Look look(0, {90, 70}, 1);
  EXPECT_EQ(find({cv::Mat(), look.mask, kSize}), 0U);
  EXPECT_EQ(find({look.color, cv::Mat(look.mask.size(), CV_8UC1, cv::Scalar(0)), kSize}), 0U);
  const std::vector<DetectionMatch> matches = detector_->find({{cv::Mat(), look.mask, kSize}, look.query()});
  EXPECT_FALSE(matches[0].object);
  EXPECT_EQ(matches[1].object.value, 1U);
}

TEST_F(DetectorTest, TheThresholdIsAParameter) {
  addObject(0);
  DetectionParams params;
  params.max_distance = 0;
  detector_->setParams(params);
  EXPECT_EQ(find(Look(0, {90, 70}, 0).query()), 0U);
}

}  // namespace
}  // namespace scantrove
