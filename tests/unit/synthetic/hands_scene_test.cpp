#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

class HandsSceneTest : public testing::TestWithParam<std::uint32_t> {
 protected:
  static SyntheticOptions options() {
    SyntheticOptions options;
    options.recipe = [] { return synthetic::makeRandomHandsScene(GetParam()); };
    options.K = options.K.resizedTo(320, 240);
    options.noise = options.color = false;
    options.stride = 7;
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(Seeds, HandsSceneTest, testing::Range(1U, 9U));

TEST_P(HandsSceneTest, HandsMoveThreeThings_AndNothingElse) {
  const auto source = makeSyntheticSource(options()).value();
  const SyntheticScene& scene = source->scene();
  ASSERT_FALSE(scene.instances().empty()) << "everything fits on some table";
  std::map<std::uint16_t, Eigen::AlignedBox3d> before;
  for (const InstanceName& who : scene.instances())
    if (who.is_object) before[who.id] = scene.boundsOf(who.id);
  EXPECT_GE(before.size(), 6U);
  std::map<std::uint16_t, int> lifted_frames;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    for (const auto& [id, bounds] : before)
      lifted_frames[id] += scene.boundsOf(id).min().z() > bounds.min().z() + 0.1 ? 1 : 0;
  }
  int moved = 0;
  for (const auto& [id, bounds] : before) {
    const Eigen::Vector3d motion = scene.boundsOf(id).center() - bounds.center();
    EXPECT_NEAR(motion.z(), 0, 1e-9) << "it stands on the table again";
    if (motion.norm() < 1e-9) {
      EXPECT_EQ(lifted_frames[id], 0);
      continue;
    }
    ++moved;
    EXPECT_GE(motion.norm(), 0.2);
    EXPECT_GE(lifted_frames[id], 6) << "held for two seconds, every seventh frame";
  }
  EXPECT_EQ(moved, 3);
}

TEST_P(HandsSceneTest, HandsAreNoObjects_AndLeaveTheView) {
  const auto source = makeSyntheticSource(options()).value();
  const SyntheticScene& scene = source->scene();
  const std::uint16_t left = scene.find("hand, left"), right = scene.find("hand, right");
  ASSERT_TRUE(left != 0 && right != 0);
  EXPECT_FALSE(scene.instances()[left - 1U].is_object);
  EXPECT_FALSE(scene.instances()[right - 1U].is_object);
  std::vector<double> share;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const cv::Mat hands = (read.frame.instances == left) | (read.frame.instances == right);
    share.push_back(cv::countNonZero(hands) / static_cast<double>(hands.total()));
  }
  EXPECT_EQ(share.front(), 0);
  EXPECT_GT(std::ranges::max(share), 0.02);
  EXPECT_LT(std::ranges::max(share), 0.6);
  EXPECT_EQ(share.back(), 0);
}

TEST_P(HandsSceneTest, CameraStandsStill) {
  const auto source = makeSyntheticSource(options()).value();
  for (const int frame : {1, 100, 499})
    EXPECT_TRUE(source->pose(frame).matrix() == source->pose(0).matrix()) << frame;
}

}  // namespace
}  // namespace scantrove
