#include "core/pipeline/camera_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scantrove::test {
namespace {

Eigen::Isometry3d poseOf(double x) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(x, 0.2, -0.3)).rotate(Eigen::AngleAxisd(x, Eigen::Vector3d::UnitY()));
  return T;
}

cv::Mat imageOf(int width, int height, int type, int value) {
  cv::Mat image(height, width, type);
  for (int v = 0; v < height; ++v)
    std::fill_n(image.ptr(v), static_cast<std::size_t>(width) * image.elemSize(),
                static_cast<unsigned char>(value + v));
  return image;
}

KeyFrame keyFrameOf(double x) {
  KeyFrame key_frame;
  key_frame.T_world_camera = poseOf(x);
  key_frame.landmarks.points_world = {{1, 2, 3}, {4, 5, 6}};
  key_frame.landmarks.descriptors = imageOf(32, 2, CV_8UC1, 7);
  key_frame.thumbnail = imageOf(40, 30, CV_32FC1, 1);
  return key_frame;
}

SeenSurfaces::View viewOf(double x) {
  const Intrinsics K{50, 51, 3, 2, 7, 5};
  return {poseOf(x), StoredSurface(K, imageOf(7, 5, CV_16UC1, 9)), x > 1};
}

DeviceMotion::Memory deviceOf(double x) {
  DeviceMotion::Memory device;
  device.T_device_camera = poseOf(x);
  device.time_s = 1.7e9 + x;
  device.T_world_device = poseOf(x / 2);
  device.motion = {poseOf(0.05), 0.2};
  device.drift = {0.1, 0.25};
  return device;
}

CameraMemory memoryOf(bool with_tracker) {
  const Intrinsics K{60, 61, 1.5F, 1, 4, 3};
  CameraMemory memory;
  if (with_tracker) {
    memory.tracker.emplace();
    memory.tracker->last = poseOf(0.5);
    memory.tracker->before_last = poseOf(0.4);
    memory.tracker->is_lost = true;
    memory.tracker->last_view = {imageOf(4, 3, CV_8UC1, 80), K, poseOf(0.01)};
    memory.tracker->places = {keyFrameOf(0.9), keyFrameOf(1.1)};
    memory.tracker->surfaces = {viewOf(0.8), viewOf(1.2)};
    memory.reference_normals_world.assign(12, {0, 0, 1, 1});
  }
  memory.free_space.views = 29;
  memory.free_space.witnesses.push_back({K, poseOf(2), imageOf(4, 3, CV_32FC1, 3)});
  memory.appeared_objects = {{{{1, -2, 3}, 5, 8, 4}, {{2, 0, 0}, 6, 9, 3}}, 29};
  memory.color_turns = {17, 5};
  memory.view.K = K;
  memory.view.T_world_camera = poseOf(0.6);
  memory.view.vertices_world.assign(12, {1, 2, 3, 1});
  memory.view.normals_world.assign(12, {0, 1, 0, 1});
  return memory;
}

TEST(CameraMemory, ReadsBackEqual_WithAndWithoutTracker) {
  for (const bool with_tracker : {true, false}) {
    const std::vector<std::uint32_t> words = toWords(memoryOf(with_tracker));
    const auto back = cameraMemoryFrom(words);
    ASSERT_TRUE(back);
    EXPECT_EQ(toWords(*back), words);
    EXPECT_EQ(back->free_space.views, 29);
    EXPECT_EQ(back->color_turns.frame, 17U);
    EXPECT_EQ(back->view.T_world_camera.matrix(), poseOf(0.6).matrix());
    EXPECT_EQ(back->view.vertices_world[11].z(), 3);
    ASSERT_EQ(back->tracker.has_value(), with_tracker);
    if (!with_tracker) continue;
    EXPECT_EQ(back->tracker->before_last->matrix(), poseOf(0.4).matrix());
    EXPECT_TRUE(back->tracker->is_lost);
    ASSERT_EQ(back->tracker->places.size(), 2U);
    EXPECT_EQ(back->tracker->places[1].landmarks.points_world[1].z, 6);
    EXPECT_EQ(back->tracker->surfaces[1].surface.units().at<std::uint16_t>(4, 6), 13 * 257);
    EXPECT_TRUE(back->tracker->surfaces[1].is_revisitable);
    EXPECT_FALSE(back->tracker->surfaces[0].is_revisitable);
  }
}

TEST(CameraMemory, ReadsBackNoPoseBeforeLast_WhenThereIsNone) {
  CameraMemory memory = memoryOf(true);
  memory.tracker->before_last.reset();
  const auto back = cameraMemoryFrom(toWords(memory));
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->tracker->before_last);
}

TEST(CameraMemory, ReadsBackTheMotionOfADevice) {
  CameraMemory memory = memoryOf(true);
  for (const bool has_jumped : {false, true}) {
    memory.tracker->device = deviceOf(0.7);
    if (has_jumped) memory.tracker->device->jump = {poseOf(0.6), 0.3};
    const std::vector<std::uint32_t> words = toWords(memory);
    const auto back = cameraMemoryFrom(words);
    ASSERT_TRUE(back && back->tracker->device);
    EXPECT_EQ(toWords(*back), words);
    const DeviceMotion::Memory& device = *back->tracker->device;
    EXPECT_EQ(device.T_device_camera.matrix(), poseOf(0.7).matrix());
    EXPECT_EQ(device.T_world_device.matrix(), poseOf(0.35).matrix());
    EXPECT_EQ(device.time_s, 1.7e9 + 0.7);
    EXPECT_EQ(device.motion.duration_s, 0.2);
    EXPECT_EQ(device.jump.isKnown(), has_jumped);
    EXPECT_EQ(device.drift.distance_m, 0.25);
    for (std::size_t length = words.size() - 80; length < words.size(); ++length)
      EXPECT_FALSE(cameraMemoryFrom(std::span(words).first(length))) << length;
  }
}

TEST(CameraMemory, IsRefused_WhenTheMotionOfTheDeviceIsDamaged) {
  CameraMemory memory = memoryOf(true);
  for (const double wrong : {-1.0, std::nan("")}) {
    memory.tracker->device = deviceOf(0.7);
    memory.tracker->device->motion.duration_s = wrong;
    EXPECT_FALSE(cameraMemoryFrom(toWords(memory))) << wrong;
  }
  memory.tracker->device = deviceOf(0.7);
  memory.tracker->device->drift.angle_rad = -0.1;
  EXPECT_FALSE(cameraMemoryFrom(toWords(memory)));
}

// Any truncation is refused. A changed word is refused or read completely; the address sanitizer verifies
// that no read leaves the buffer.
TEST(CameraMemory, IsRefused_WhenDamaged) {
  const std::vector<std::uint32_t> words = toWords(memoryOf(true));
  for (std::size_t length = 0; length < words.size(); ++length)
    EXPECT_FALSE(cameraMemoryFrom(std::span(words).first(length))) << length;
  std::vector<std::uint32_t> longer = words;
  longer.push_back(0);
  EXPECT_FALSE(cameraMemoryFrom(longer));
  int refused = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (const std::uint32_t value : {0xffffffffU, 0x7fffffffU, 0x0000ffffU}) {
      std::vector<std::uint32_t> changed = words;
      changed[i] = value;
      refused += cameraMemoryFrom(changed) ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 40);  // the version, sizes, types and counts
}

}  // namespace
}  // namespace scantrove::test
