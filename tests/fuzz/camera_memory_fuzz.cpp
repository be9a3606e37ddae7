// The camera memory of a session.
#include <cmath>
#include <cstring>

#include "core/pipeline/camera_memory.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

KeyFrame someKeyFrame() {
  KeyFrame key_frame;
  key_frame.landmarks.points_world = {{1, 2, 3}, {4, 5, 6}};
  key_frame.landmarks.descriptors = cv::Mat(2, 32, CV_8UC1, cv::Scalar(7));
  key_frame.thumbnail = cv::Mat(6, 8, CV_32FC1, cv::Scalar(1));
  return key_frame;
}

enum class With { nothing, tracker, device };

CameraMemory someMemory(With with) {
  const bool with_tracker = with != With::nothing;
  const Intrinsics K{60, 61, 1.5F, 1, 4, 3};
  CameraMemory memory;
  if (with_tracker) {
    memory.tracker.emplace();
    memory.tracker->before_last = Eigen::Isometry3d::Identity();
    memory.tracker->last_view = {cv::Mat(3, 4, CV_8UC1, cv::Scalar(9)), K, Eigen::Isometry3d::Identity()};
    memory.tracker->places = {someKeyFrame()};
    memory.tracker->surfaces = {
        {Eigen::Isometry3d::Identity(), StoredSurface(K, cv::Mat(3, 4, CV_16UC1, cv::Scalar(900))), false}};
    memory.reference_normals_world.assign(12, {0, 0, 1, 1});
  }
  if (with == With::device) {
    DeviceMotion::Memory& device = memory.tracker->device.emplace(DeviceMotion::Memory{});
    device.time_s = 3;
    device.motion.duration_s = device.jump.duration_s = 0.2;
    device.drift = {0.1, 0.2};
  }
  memory.free_space.witnesses.push_back(
      {K, Eigen::Isometry3d::Identity(), cv::Mat(3, 4, CV_32FC1, cv::Scalar(3))});
  memory.appeared_objects = {{{{1, -2, 3}, 5, 8, 4}}, 29};
  memory.view.K = K;
  memory.view.vertices_world.assign(12, {1, 2, 3, 1});
  memory.view.normals_world.assign(12, {0, 1, 0, 1});
  return memory;
}

bool isRigid(const Eigen::Isometry3d& T) {
  return T.matrix().allFinite() && std::abs(T.linear().determinant() - 1) < 1e-2;
}

bool isUsable(const Intrinsics& K) {
  return std::isfinite(K.fx) && std::isfinite(K.fy) && K.fx > 0 && K.fy > 0 && K.width > 0 && K.height > 0;
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> all;
  for (const With with : {With::nothing, With::tracker, With::device}) {
    const std::vector<std::uint32_t> words = toWords(someMemory(with));
    all.emplace_back(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint32_t));
  }
  return all;
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  std::vector<std::uint32_t> words(size / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), data, words.size() * sizeof(std::uint32_t));
  const auto memory = cameraMemoryFrom(words);
  if (!memory) return 0;
  test::require(test::isUsable(memory->view.K) && test::isRigid(memory->view.T_world_camera),
                "the camera of the view is usable");
  for (const FreeSpace::Witness& witness : memory->free_space.witnesses)
    test::require(test::isUsable(witness.K) && test::isRigid(witness.T_camera_world),
                  "the camera of a witness is usable");
  if (!memory->tracker) return 0;
  test::require(test::isRigid(memory->tracker->last), "the last pose is rigid");
  if (const auto& device = memory->tracker->device) {
    test::require(test::isRigid(device->T_device_camera) && test::isRigid(device->T_world_device) &&
                      test::isRigid(device->motion.motion) && test::isRigid(device->jump.motion),
                  "the poses of a device are rigid");
    test::require(
        std::isfinite(device->time_s) && device->motion.duration_s >= 0 && device->jump.duration_s >= 0,
        "its times are times");
  }
  for (const KeyFrame& key_frame : memory->tracker->places) {
    test::require(test::isRigid(key_frame.T_world_camera), "a tracking key frame has a rigid pose");
    test::require(key_frame.landmarks.descriptors.empty() || key_frame.landmarks.descriptors.cols == 32,
                  "descriptors of landmarks have 256 bits");
  }
  for (const SeenSurfaces::View& view : memory->tracker->surfaces)
    test::require(test::isUsable(view.surface.intrinsics()) && test::isRigid(view.T_world_camera),
                  "the camera of a surface is usable");
  return 0;
}
