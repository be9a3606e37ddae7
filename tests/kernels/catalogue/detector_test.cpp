#include "core/catalogue/detector.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace scantrove {
namespace {

const Eigen::Vector3f kSize(0.2F, 0.15F, 0.1F);

/// An ellipse with coloured patches that depend on the seed, with camera noise and a background that depends
/// on `scene`.
struct ObjectImage {
  cv::Mat color, mask;
  ObjectImage(int seed, const cv::Size& size, int scene) {
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
  /// Adds object seed + 1 as its own merge root.
  void addObject(int seed) {
    const ObjectImage image(seed, {90, 70}, 0);
    const ObjectId object{static_cast<std::uint32_t>(seed + 1)};
    detector_->add({seed + 1, object, kSize, describeView(image.color, image.mask).value(), {}});
    detector_->setMergeRoot({object, object});
  }
  std::uint32_t find(const DetectionQuery& query) { return detector_->find({query})[0].object.value; }

  std::unique_ptr<ComputeContext> compute_;
  std::optional<Detector> detector_;
};

TEST_F(DetectorTest, FindsNothing_WhenTheCatalogueIsEmpty) {
  EXPECT_EQ(detector_->viewCount(), 0);
  EXPECT_FALSE(detector_->find({ObjectImage(0, {90, 70}, 0).query()})[0].object);
  EXPECT_TRUE(detector_->find({}).empty());
}

TEST_F(DetectorTest, FindsObjects_WhenImageSizeAndBackgroundDiffer) {
  for (int seed = 0; seed < 20; ++seed) addObject(seed);
  std::vector<DetectionQuery> queries;
  for (int seed = 0; seed < 20; ++seed) queries.push_back(ObjectImage(seed, {61, 50}, seed + 1).query());
  for (int seed = 20; seed < 40; ++seed) queries.push_back(ObjectImage(seed, {61, 50}, seed + 1).query());
  const std::vector<DetectionMatch> matches = detector_->find(queries);
  ASSERT_EQ(matches.size(), 40U);
  for (std::uint32_t i = 0; i < 20; ++i) {
    EXPECT_EQ(matches[i].object.value, i + 1) << matches[i].distance;
    EXPECT_LT(matches[i].distance, 0.15F);
  }
  for (std::size_t i = 20; i < 40; ++i) EXPECT_FALSE(matches[i].object) << i << " " << matches[i].distance;
}

TEST_F(DetectorTest, WarmUpKeepsTheCatalogue) {
  detector_->warmUp();
  EXPECT_FALSE(detector_->find({ObjectImage(0, {90, 70}, 0).query()})[0].object) << "still empty";
  for (int seed = 0; seed < 3; ++seed) addObject(seed);
  detector_->warmUp();
  EXPECT_EQ(detector_->viewCount(), 3);
  for (int seed = 0; seed < 3; ++seed)
    EXPECT_EQ(find(ObjectImage(seed, {61, 50}, 9).query()), static_cast<std::uint32_t>(seed + 1));
}

TEST_F(DetectorTest, FindsObjects_AmongManyAfterPruning) {
  for (int seed = 0; seed < 400; ++seed) addObject(seed);
  EXPECT_EQ(detector_->viewCount(), 400);
  int found = 0;
  for (int seed = 0; seed < 400; seed += 8) {
    found += find(ObjectImage(seed, {75, 64}, seed).query()) == static_cast<std::uint32_t>(seed + 1) ? 1 : 0;
  }
  EXPECT_GE(found, 49);  // of 50
}

TEST_F(DetectorTest, FindsAnObject_OnceAdded) {
  for (int seed = 0; seed < 5; ++seed) addObject(seed);
  EXPECT_EQ(find(ObjectImage(4, {90, 70}, 1).query()), 5U);
  EXPECT_EQ(find(ObjectImage(5, {90, 70}, 1).query()), 0U);
  addObject(5);
  EXPECT_EQ(find(ObjectImage(5, {90, 70}, 1).query()), 6U);
}

// Merging, deleting and undoing change only the merge root of views.
TEST_F(DetectorTest, ReturnsTheCurrentMergeRoot) {
  for (int seed = 0; seed < 5; ++seed) addObject(seed);
  const DetectionQuery query = ObjectImage(4, {90, 70}, 1).query();
  detector_->setMergeRoot({ObjectId{5}, ObjectId{2}});
  EXPECT_EQ(find(query), 2U);
  EXPECT_EQ(detector_->mergeRootOf(ObjectId{5}), ObjectId{2});
  detector_->setMergeRoot({ObjectId{5}, {}});
  EXPECT_EQ(find(query), 0U);
  EXPECT_EQ(find(ObjectImage(0, {90, 70}, 1).query()), 1U);
  detector_->setMergeRoot({ObjectId{5}, ObjectId{5}});
  EXPECT_EQ(find(query), 5U);
  EXPECT_FALSE(detector_->mergeRootOf(ObjectId{99}));
  EXPECT_EQ(detector_->viewCount(), 5);
}

TEST_F(DetectorTest, FindsNothing_WhenTheSizeDiffers) {
  addObject(0);
  EXPECT_EQ(find(ObjectImage(0, {90, 70}, 1).query(1.3F * kSize)), 1U);
  EXPECT_EQ(find(ObjectImage(0, {90, 70}, 1).query(2 * kSize)), 0U);
  EXPECT_EQ(find(ObjectImage(0, {90, 70}, 1).query(0.5F * kSize)), 0U);
  EXPECT_EQ(find(ObjectImage(0, {90, 70}, 1).query(Eigen::Vector3f::Zero())), 1U);  // unknown size
}

TEST_F(DetectorTest, FindsNothing_WhenTheColorDiffers) {
  addObject(0);
  ObjectImage painted(0, {90, 70}, 1);
  painted.color += cv::Scalar(0, 0, 90);
  EXPECT_EQ(find(painted.query()), 0U);
}

TEST_F(DetectorTest, NamesTheNearestObject_WhenNoneMatches) {
  addObject(0);
  ObjectImage worn(0, {90, 70}, 1);
  cv::addWeighted(worn.color, 0.4, ObjectImage(1, {90, 70}, 1).color, 0.6, 0, worn.color);
  const DetectionMatch match = detector_->find({worn.query()})[0];
  EXPECT_FALSE(match.object);
  EXPECT_EQ(match.nearest, ObjectId{1});
  const DetectionMatch large = detector_->find({worn.query(3 * kSize)})[0];
  EXPECT_FALSE(large.object);
  EXPECT_GT(large.nearest_distance, match.nearest_distance) << "no object is this large";
  EXPECT_EQ(large.thumbnail_distance, 2) << "no view is this large";
}

TEST_F(DetectorTest, MatchesAGuess_WhenOnlyHalfOfTheObjectIsKnown) {
  for (int seed = 0; seed < 3; ++seed) addObject(seed);
  DetectionQuery half = ObjectImage(1, {90, 70}, 1).query(0.55F * kSize);
  EXPECT_FALSE(detector_->find({half})[0].guess) << "there are no guesses";
  half.guesses = {ObjectId{1}, ObjectId{2}};
  const DetectionMatch match = detector_->find({half})[0];
  EXPECT_EQ(match.guess, ObjectId{2});
  EXPECT_LT(match.guess_distance, 0.15F);
  EXPECT_FALSE(match.object) << "no object is this small";
  half.size_m = 0.4F * kSize;
  EXPECT_FALSE(detector_->find({half})[0].guess) << "less than half";
  half.size_m = 1.6F * kSize;
  EXPECT_FALSE(detector_->find({half})[0].guess) << "larger than the object";
}

TEST_F(DetectorTest, GuessesDoNotAffectTheMatch) {
  for (int seed = 0; seed < 3; ++seed) addObject(seed);
  DetectionQuery query = ObjectImage(1, {90, 70}, 1).query();
  query.guesses = {ObjectId{1}};
  const DetectionMatch match = detector_->find({query})[0];
  EXPECT_EQ(match.object, ObjectId{2});
  EXPECT_EQ(match.nearest, ObjectId{2});
}

TEST_F(DetectorTest, FindsNothing_WithoutColorOrMask) {
  addObject(0);
  ObjectImage image(0, {90, 70}, 1);
  EXPECT_EQ(find({cv::Mat(), image.mask, kSize}), 0U);
  EXPECT_EQ(find({image.color, cv::Mat(image.mask.size(), CV_8UC1, cv::Scalar(0)), kSize}), 0U);
  const std::vector<DetectionMatch> matches =
      detector_->find({{cv::Mat(), image.mask, kSize}, image.query()});
  EXPECT_FALSE(matches[0].object);
  EXPECT_EQ(matches[1].object.value, 1U);
}

/// Pixels of two colours of the object in random order: only the colours tell objects apart.
ObjectImage speckled(int object, int scene) {
  const std::array<cv::Vec3b, 8> palette{{{30, 30, 190},
                                          {190, 40, 30},
                                          {40, 160, 40},
                                          {40, 200, 210},
                                          {190, 180, 40},
                                          {170, 50, 170},
                                          {220, 220, 220},
                                          {50, 50, 50}}};
  ObjectImage image(0, {40, 40}, scene);
  image.mask.setTo(255);
  cv::RNG random(static_cast<std::uint64_t>(scene * 100 + object + 1));
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const auto first = static_cast<std::size_t>(2 * object);
      image.color.at<cv::Vec3b>(y, x) = palette[first + static_cast<std::size_t>(random.uniform(0, 2))];
    }
  }
  return image;
}

TEST_F(DetectorTest, PrefersTheSameColors_WhenNoShapeMatches) {
  for (int i = 0; i < 4; ++i) {
    const ObjectImage image = speckled(i, 0);
    const ObjectId object{static_cast<std::uint32_t>(i + 1)};
    detector_->add({i + 1, object, kSize, describeView(image.color, image.mask).value(), {}});
    detector_->setMergeRoot({object, object});
  }
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(detector_->find({speckled(i, 1).query()})[0].nearest,
              ObjectId{static_cast<std::uint32_t>(i + 1)});
  }
}

TEST_F(DetectorTest, ComparesByThumbnailAlone_WhenAViewHasNoColors) {
  const ObjectImage image(0, {90, 70}, 0);
  ViewDescriptor old = describeView(image.color, image.mask).value();
  old.colors.reset();
  detector_->add({1, ObjectId{1}, kSize, old, {}});
  detector_->setMergeRoot({ObjectId{1}, ObjectId{1}});
  EXPECT_EQ(find(ObjectImage(0, {61, 50}, 1).query()), 1U);
  EXPECT_EQ(find(ObjectImage(1, {61, 50}, 1).query()), 0U);
}

// The distance of the nearest is the same, but five others are as near.
TEST_F(DetectorTest, IsLessSure_WhenManyObjectsLookAlike) {
  for (int seed = 0; seed < 10; ++seed) addObject(seed);
  ObjectImage worn(0, {90, 70}, 1);
  cv::addWeighted(worn.color, 0.8, ObjectImage(20, {90, 70}, 1).color, 0.2, 0, worn.color);
  const DetectionMatch alone = detector_->find({worn.query()})[0];
  EXPECT_EQ(alone.nearest, ObjectId{1});
  const ObjectImage image(0, {90, 70}, 0);
  for (std::uint32_t copy = 100; copy < 105; ++copy) {
    detector_->add({copy, ObjectId{copy}, kSize, describeView(image.color, image.mask).value(), {}});
    detector_->setMergeRoot({ObjectId{copy}, ObjectId{copy}});
  }
  const DetectionMatch among = detector_->find({worn.query()})[0];
  EXPECT_EQ(among.nearest_distance, alone.nearest_distance);
  EXPECT_GT(among.distance, 1.5F * alone.distance);
}

TEST_F(DetectorTest, NamesTheNetwork_WhenItCannotBeRead) {
  const Result<Detector> detector = Detector::create(*compute_, "/nowhere/net.onnx");
  ASSERT_FALSE(detector);
  EXPECT_NE(detector.error().message().find("/nowhere/net.onnx"), std::string::npos);
}

TEST_F(DetectorTest, FindsNothing_WhenTheMaximumDistanceIsZero) {
  addObject(0);
  DetectionParams params;
  params.max_distance = 0;
  detector_->setParams(params);
  EXPECT_EQ(find(ObjectImage(0, {90, 70}, 0).query()), 0U);
}

}  // namespace
}  // namespace scantrove
