#include "core/tracking/pose_tracker.h"

#include <gtest/gtest.h>

#include "core/synthetic/synthetic_source.h"
#include "tests/kernels/tracking/tracking_test_support.h"
#include "tests/support/each_device.h"
#include "tests/support/tracking_rig.h"

namespace scantrove::test {
namespace {

std::vector<RgbdFrame> recorded(synthetic::SceneRecipe (*recipe)(), int frames, int stride,
                                bool color = true) {
  SyntheticOptions options;
  options.recipe = recipe;
  options.frames = frames;
  options.stride = stride;
  options.color = color;
  const auto source = makeSyntheticSource(options).value();
  std::vector<RgbdFrame> result;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next())
    result.push_back(std::move(read.frame));
  return result;
}

const Intrinsics kCamera = SyntheticOptions{}.K;

RgbdFrame covered(const RgbdFrame& like) {
  RgbdFrame frame = like;
  frame.depth = cv::Mat::zeros(like.depth.size(), like.depth.type());
  if (!like.color.empty()) frame.color = cv::Mat::zeros(like.color.size(), like.color.type());
  return frame;
}

/// The position error in metres. The world frame is the camera frame of `first`, which started the map.
double errorOf_m(const PoseEstimate& pose, const RgbdFrame& frame, const RgbdFrame& first) {
  const Eigen::Isometry3d truth = first.T_world_camera->inverse() * *frame.T_world_camera;
  return (pose.T_world_camera.translation() - truth.translation()).norm();
}

// On a bare wall, depth leaves three directions free.
TEST(PoseTracker, TracksAPaintedWall_ByColor) {
  const std::vector<RgbdFrame> frames = recorded(synthetic::makeWallScene, 100, 3);
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kCamera);
    for (const RgbdFrame& frame : frames) {
      const PoseEstimate pose = rig.show(frame);
      ASSERT_EQ(pose.state, TrackingState::tracking) << frame.index;
      EXPECT_LT(errorOf_m(pose, frame, frames.front()), 0.020) << frame.index;
    }
  });
}

TEST(PoseTracker, GivesNoWrongPose_OnAWallWithoutColor) {
  const std::vector<RgbdFrame> frames = recorded(synthetic::makeWallScene, 60, 4, false);
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kCamera);
    for (const RgbdFrame& frame : frames) {
      const PoseEstimate pose = rig.show(frame);
      if (!pose.usable()) continue;
      EXPECT_LT(errorOf_m(pose, frame, frames.front()), 0.010) << frame.index;
    }
  });
}

// Motion prediction fails over 20 frames of hand motion.
TEST(PoseTracker, TracksWideSteps) {
  const std::vector<RgbdFrame> frames = recorded(synthetic::makeTabletopScene, 300, 20);
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kCamera);
    for (const RgbdFrame& frame : frames) {
      const PoseEstimate pose = rig.show(frame);
      EXPECT_TRUE(pose.usable()) << frame.index;
      EXPECT_LT(errorOf_m(pose, frame, frames.front()), 0.020) << frame.index;
    }
  });
}

TEST(PoseTracker, Relocalizes_AtVisitedPoses) {
  for (const bool color : {true, false}) {
    const std::vector<RgbdFrame> frames = recorded(synthetic::makeTabletopScene, 180, 9, color);
    onEachDevice([&](ComputeContext& compute) {
      SCOPED_TRACE(color ? "with colour" : "without colour");
      TrackingRig rig(compute, kCamera);
      for (const RgbdFrame& frame : frames) ASSERT_TRUE(rig.show(frame).usable()) << frame.index;
      for (const std::size_t elsewhere : {4UL, 14UL, 9UL}) {
        for (int i = 0; i < 3; ++i) EXPECT_EQ(rig.show(covered(frames.front())).state, TrackingState::lost);
        PoseEstimate pose;
        std::size_t tries = 0;
        for (; tries < 5 && !pose.usable(); ++tries) pose = rig.show(frames[elsewhere + tries]);
        ASSERT_EQ(pose.state, TrackingState::relocalized) << elsewhere;
        EXPECT_LT(errorOf_m(pose, frames[elsewhere + tries - 1], frames.front()), 0.010)
            << elsewhere << ": inliers " << pose.inlier_fraction << ", rmse " << pose.rmse_m;
      }
    });
  }
}

TEST(PoseTracker, Relocalizes_WhenEverySecondFrameHasColor) {
  std::vector<RgbdFrame> frames = recorded(synthetic::makeTabletopScene, 180, 9);
  for (std::size_t i = 1; i < frames.size(); i += 2) frames[i].color.release();
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kCamera);
    for (const RgbdFrame& frame : frames) ASSERT_TRUE(rig.show(frame).usable()) << frame.index;
    for (const std::size_t elsewhere : {4UL, 14UL, 8UL}) {
      for (int i = 0; i < 3; ++i) EXPECT_EQ(rig.show(covered(frames.front())).state, TrackingState::lost);
      PoseEstimate pose;
      std::size_t tries = 0;
      for (; tries < 6 && !pose.usable(); ++tries) pose = rig.show(frames[elsewhere + tries]);
      ASSERT_EQ(pose.state, TrackingState::relocalized) << elsewhere;
      EXPECT_LT(errorOf_m(pose, frames[elsewhere + tries - 1], frames.front()), 0.010) << elsewhere;
    }
  });
}

/// A frame of a room corner of which only the rectangle `keyhole` has depth.
RgbdFrame through(const cv::Rect& keyhole, int index) {
  AnalyticScene scene = roomCorner();
  scene.sphere({0.8, -0.4, 1.9}, 0.25).sphere({0.7, 0.1, 1.5}, 0.2).sphere({-0.6, 0.4, 1.7}, 0.2);
  RgbdFrame frame = frameOf(scene, kKinect, pose(0.2 * index, 0, 0, 0.002 * index, 0, 0));
  frame.index = index;
  cv::Mat seen = cv::Mat::zeros(frame.depth.size(), frame.depth.type());
  frame.depth(keyhole).copyTo(seen(keyhole));
  frame.depth = seen;
  return frame;
}
const cv::Rect kFirstView(0, 0, 330, 480);
// This view overlaps the first in a twentieth of the image, too little for a certain pose.
const cv::Rect kUncertainView(295, 0, 345, 480);

TEST(PoseTracker, ConfirmsAnUncertainPose_ByLaterFrames) {
  onEachDevice([](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect);
    ASSERT_TRUE(rig.show(through(kFirstView, 0)).usable());
    ASSERT_EQ(rig.show(through(kUncertainView, 1)).state, TrackingState::uncertain);
    EXPECT_TRUE(rig.takeLateFrames().empty());
    ASSERT_TRUE(rig.show(through({0, 0, 640, 480}, 2)).usable());
    const std::vector<std::pair<int, PoseEstimate>> late = rig.takeLateFrames();
    ASSERT_EQ(late.size(), 1U);
    EXPECT_EQ(late.front().first, 1);
    const Eigen::Isometry3d truth = pose(0.2, 0, 0, 0.002, 0, 0);
    EXPECT_LT((late.front().second.T_world_camera.translation() - truth.translation()).norm(), 0.002);
    EXPECT_TRUE(rig.takeLateFrames().empty()) << "reported once";
  });
}

TEST(PoseTracker, DropsAnUncertainPose_WhenNeverConfirmed) {
  onEachDevice([](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect);
    ASSERT_TRUE(rig.show(through(kFirstView, 0)).usable());
    ASSERT_EQ(rig.show(through(kUncertainView, 1)).state, TrackingState::uncertain);
    for (int i = 0; i < 12; ++i) {
      ASSERT_TRUE(rig.show(through(kFirstView, 0)).usable()) << i;
      EXPECT_TRUE(rig.takeLateFrames().empty()) << "no later frame confirms the uncertain view";
    }
    ASSERT_TRUE(rig.show(through({0, 0, 640, 480}, 2)).usable());
    EXPECT_TRUE(rig.takeLateFrames().empty()) << "the uncertain view was dropped";
  });
}

TEST(PoseTracker, FindsNoPose_InAnotherScene) {
  for (const bool color : {true, false}) {
    const std::vector<RgbdFrame> here = recorded(synthetic::makeTabletopScene, 120, 6, color);
    const std::vector<RgbdFrame> elsewhere = recorded(synthetic::makeRoomScene, 400, 40, color);
    onEachDevice([&](ComputeContext& compute) {
      TrackingRig rig(compute, kCamera);
      for (const RgbdFrame& frame : here) ASSERT_TRUE(rig.show(frame).usable()) << frame.index;
      for (const RgbdFrame& frame : elsewhere) EXPECT_FALSE(rig.show(frame).usable()) << frame.index;
    });
  }
}

}  // namespace
}  // namespace scantrove::test
