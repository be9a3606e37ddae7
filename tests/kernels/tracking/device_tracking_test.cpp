// PoseTracker with the poses of a device that tracks itself.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/synthetic/synthetic_source.h"
#include "tests/kernels/tracking/tracking_test_support.h"
#include "tests/support/each_device.h"
#include "tests/support/tracking_rig.h"

namespace scantrove::test {
namespace {

constexpr auto kByDevice = PoseTracker::Predictor::device;

/// A recording of a device, and the true poses.
struct DeviceRecording {
  std::vector<RgbdFrame> frames;
  std::vector<Eigen::Isometry3d> truth;
};

DeviceRecording recordedByDevice(synthetic::SceneRecipe (*recipe)(), int frames, int stride,
                                 const synthetic::DeviceErrors& errors) {
  SyntheticOptions options;
  options.recipe = recipe;
  options.frames = frames;
  options.stride = stride;
  options.color = false;
  options.device = errors;
  options.frames_per_second = 5;
  const auto source = makeSyntheticSource(options).value();
  DeviceRecording recording;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    recording.truth.push_back(source->pose(read.frame.index));
    recording.frames.push_back(std::move(read.frame));
  }
  return recording;
}

double distance_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

// Someone hurries along a corridor with a phone that stores five frames a second.
TEST(DeviceTracking, HoldsInSixtyCentimeterSteps) {
  const DeviceRecording corridor = recordedByDevice(synthetic::makeCorridorScene, 24 * 12, 24, {});
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, SyntheticOptions{}.K, kByDevice);
    double way_m = 0;
    for (std::size_t i = 0; i < corridor.frames.size(); ++i) {
      if (i > 0) way_m += distance_m(corridor.truth[i], corridor.truth[i - 1]);
      const PoseEstimate found = rig.show(corridor.frames[i]);
      ASSERT_TRUE(found.usable()) << i;
      EXPECT_FALSE(found.has_device_jumped) << i;
      EXPECT_LT(distance_m(found.T_world_camera, corridor.truth[i]), 0.03 + 0.02 * way_m) << i;
    }
    EXPECT_GT(way_m, 6);
  });
}

// A bare wall without colour determines three of six directions; the device knows the others.
TEST(DeviceTracking, TakesFromTheDevice_WhatTheSurfaceDoesNotDetermine) {
  const DeviceRecording wall = recordedByDevice(
      synthetic::makeWallScene, 60, 4, {.scale = 1, .turn_rad_per_m = 0, .noise_m = 0, .noise_rad = 0});
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, SyntheticOptions{}.K, kByDevice);
    for (std::size_t i = 0; i < wall.frames.size(); ++i) {
      const PoseEstimate found = rig.show(wall.frames[i]);
      ASSERT_EQ(found.state, TrackingState::tracking) << i;
      EXPECT_LT(distance_m(found.T_world_camera, wall.truth[i]), 0.010) << i;
    }
  });
}

/// A frame of a room corner at a pose of the device; `moved`: the true pose.
RgbdFrame cornerFrom(const Eigen::Isometry3d& moved, const Eigen::Isometry3d& device, int index) {
  AnalyticScene scene = roomCorner();
  scene.sphere({0.8, -0.4, 1.9}, 0.25).sphere({0.7, 0.1, 1.5}, 0.2).sphere({-0.6, 0.4, 1.7}, 0.2);
  RgbdFrame frame = frameOf(scene, kKinect, moved);
  frame.index = index;
  frame.timestamp_s = index / 30.0;
  frame.T_world_camera = device;
  return frame;
}

TEST(DeviceTracking, BeginsInTheDevicesWorld) {
  const Eigen::Isometry3d first = pose(3, 20, -1, 0.5, 1.5, -2);
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect, kByDevice);
    const PoseEstimate found = rig.show(cornerFrom(Eigen::Isometry3d::Identity(), first, 0));
    EXPECT_EQ(found.T_world_camera.matrix(), first.matrix());
  });
}

// The camera turns to a part of the room that the map does not have.
TEST(DeviceTracking, FollowsTheDevice_WhereAllIsNew) {
  const Eigen::Isometry3d there = pose(0, -75, 0, 0.05, 0, 0);
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect, kByDevice);
    constexpr int kSecond = 30;  // frames
    ASSERT_TRUE(
        rig.show(cornerFrom(Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity(), 0)).usable());
    const PoseEstimate turned = rig.show(cornerFrom(there, there, kSecond));
    EXPECT_TRUE(turned.usable());
    EXPECT_TRUE(turned.is_by_device);
    EXPECT_LT(distance_m(turned.T_world_camera, there), 1e-9);
    const PoseEstimate again = rig.show(cornerFrom(there, there, 2 * kSecond));
    EXPECT_TRUE(again.usable());
    EXPECT_FALSE(again.is_by_device) << "the frame before is in the map";
  });
}

TEST(DeviceTracking, ContinuesAfterACoveredLens) {
  onEachDevice([](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect, kByDevice);
    const auto at = [](int i) { return pose(0, 2.0 * i, 0, 0.03 * i, 0, 0); };
    for (int i = 0; i < 8; ++i) {
      RgbdFrame frame = cornerFrom(at(i), at(i), i);
      const bool is_covered = i >= 2 && i < 6;
      if (is_covered) frame.depth = cv::Mat::zeros(frame.depth.size(), frame.depth.type());
      const PoseEstimate found = rig.show(frame);
      EXPECT_EQ(found.usable(), !is_covered) << i;
      if (found.usable()) {
        EXPECT_LT(distance_m(found.T_world_camera, at(i)), 0.005) << i;
      }
    }
  });
}

TEST(DeviceTracking, DoesNotBelieveAJumpOfTheDevice) {
  const Eigen::Isometry3d jump = pose(0, 4, 0, 0.5, 0, 0.1);
  constexpr int kJumpAt = 6;
  onEachDevice([&](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect, kByDevice);
    for (int i = 0; i < 10; ++i) {
      const Eigen::Isometry3d truth = pose(0, 0.2 * i, 0, 0.006 * i, 0, 0);
      const Eigen::Isometry3d device = i >= kJumpAt ? jump * truth : truth;
      const PoseEstimate found = rig.show(cornerFrom(truth, device, i));
      ASSERT_TRUE(found.usable()) << i;
      EXPECT_FALSE(found.is_by_device) << i;
      EXPECT_EQ(found.has_device_jumped, i == kJumpAt) << i;
      EXPECT_LT(distance_m(found.T_world_camera, truth), 0.005) << i;
    }
  });
}

// The hand stops at once, which looks like a jump of the device.
TEST(DeviceTracking, FollowsAJerkOfTheHand) {
  onEachDevice([](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect, kByDevice);
    for (int i = 0; i < 10; ++i) {
      const double moved_m = 0.15 * std::min(i, 4);
      const Eigen::Isometry3d truth = pose(0, 0, 0, moved_m, 0, 0);
      const PoseEstimate found = rig.show(cornerFrom(truth, truth, i));
      ASSERT_TRUE(found.usable()) << i;
      EXPECT_LT(distance_m(found.T_world_camera, truth), 0.005) << i;
    }
  });
}

TEST(DeviceTracking, TracksByTheCamera_WhereTheDeviceHasNoPose) {
  onEachDevice([](ComputeContext& compute) {
    TrackingRig rig(compute, kKinect, kByDevice);
    for (int i = 0; i < 8; ++i) {
      const Eigen::Isometry3d truth = pose(0, 0.2 * i, 0, 0.006 * i, 0, 0);
      RgbdFrame frame = cornerFrom(truth, truth, i);
      if (i == 3 || i == 4) frame.T_world_camera.reset();
      const PoseEstimate found = rig.show(frame);
      ASSERT_TRUE(found.usable()) << i;
      EXPECT_LT(distance_m(found.T_world_camera, truth), 0.005) << i;
    }
  });
}

}  // namespace
}  // namespace scantrove::test
