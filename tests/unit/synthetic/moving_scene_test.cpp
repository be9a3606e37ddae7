#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

class MovingSceneTest : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, MovingSceneTest, testing::Range(1U, 7U));

TEST_P(MovingSceneTest, PersonPassesAndMovesMugAndChair) {
  SyntheticOptions options;
  options.recipe = [] { return synthetic::makeRandomMovingScene(GetParam()); };
  options.noise = options.color = false;
  options.stride = 15;
  const auto source = makeSyntheticSource(options).value();
  const SyntheticScene& scene = source->scene();
  const std::uint16_t person = scene.find("person");
  const std::uint16_t arm = scene.find("arm");
  const std::uint16_t mug = scene.find("mug");
  const std::uint16_t chair = scene.find("chair");
  ASSERT_TRUE(person != 0 && arm != 0 && mug != 0 && chair != 0);
  const Eigen::AlignedBox3d mug_before = scene.boundsOf(mug);
  const Eigen::AlignedBox3d chair_before = scene.boundsOf(chair);

  std::vector<double> person_share, arm_share, mug_px;
  double highest = mug_before.min().z();
  Eigen::AlignedBox3d mug_at_rest;  // nothing moves after this
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const double pixels = static_cast<double>(read.frame.instances.total());
    const auto seen = [&](std::uint16_t instance) {
      return cv::countNonZero(read.frame.instances == instance);
    };
    person_share.push_back(seen(person) / pixels);
    arm_share.push_back(seen(arm) / pixels);
    mug_px.push_back(seen(mug));
    highest = std::max(highest, scene.boundsOf(mug).min().z());
    if (read.frame.index == 345) mug_at_rest = scene.boundsOf(mug);
  }
  EXPECT_EQ(person_share.front(), 0);
  EXPECT_GT(std::ranges::max(person_share), 0.05);
  EXPECT_LT(std::ranges::max(person_share), 0.45);
  EXPECT_EQ(person_share.back(), 0);
  EXPECT_EQ(arm_share.front(), 0);
  EXPECT_GT(std::ranges::max(arm_share), 0.01);
  EXPECT_EQ(arm_share.back(), 0);

  EXPECT_GT(highest, mug_before.min().z() + 0.1) << "it is lifted";
  const Eigen::Vector3d mug_motion = scene.boundsOf(mug).center() - mug_before.center();
  EXPECT_GT(mug_motion.norm(), 0.3);
  EXPECT_NEAR(mug_motion.z(), 0, 1e-9);
  EXPECT_GT(mug_px.front(), 300);
  EXPECT_GT(mug_px.back(), 300);
  EXPECT_TRUE(mug_at_rest.isApprox(scene.boundsOf(mug)));
  const double chair_motion = (scene.boundsOf(chair).center() - chair_before.center()).norm();
  EXPECT_GT(chair_motion, 0.25);
  EXPECT_LT(chair_motion, 0.5);
}

TEST(MovingScene, IsDeterministic) {
  const auto image = [] {
    SourceOptions options;
    options.start = 180;
    options.frames = 1;
    return (*makeSyntheticSource("moving:3", options))->next().frame.depth;
  };
  EXPECT_EQ(cv::norm(image(), image(), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace scantrove
