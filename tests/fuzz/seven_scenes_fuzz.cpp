// Texts of 7-Scenes and numbered folders: a pose, the camera as a matrix and as JSON, a trajectory log, and a
// file name.
#include "core/capture/camera_intrinsics.h"
#include "core/capture/folder_listing.h"
#include "core/capture/numbered_folder.h"
#include "core/capture/pose_files.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {
      "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n\x1E"
      "585 0 320\n0 585 240\n0 0 1\n\x1E"
      "{\"width\": 640, \"height\": 480, \"intrinsic_matrix\": [525, 0, 0, 0, 525, 0, 319.5, 239.5, 1], "
      "\"depth_scale\": 1000}\n\x1E"
      "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n3 3 4\n0 -1 0 7\n1 0 0 0\n0 0 1 0\n0 0 0 1\n\x1E"
      "frame-000012.depth.png"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto parts = test::partsOf({reinterpret_cast<const char*>(data), size}, 5);
  const auto pose = readPoseFile(test::rewrite(folder, "pose.txt", parts[0]));
  test::require(!pose || (std::abs(pose->linear().determinant() - 1) < 1e-6 && pose->matrix().allFinite()),
                "a pose is a rigid motion");
  for (const auto& model : {readIntrinsicsMatrix(test::rewrite(folder, "camera-intrinsics.txt", parts[1])),
                            readIntrinsicsJson(test::rewrite(folder, "intrinsic.json", parts[2]))}) {
    if (!model) continue;
    const Intrinsics K = fitToImages(*model, 640, 480);
    test::require(!checkIntrinsics(K, "input") || (K.fx > 0 && K.fy > 0 && K.width == 640),
                  "an accepted camera is usable");
  }
  const auto poses = readTrajectoryLog(test::rewrite(folder, "trajectory.log", parts[3]));
  for (const NumberedPose& numbered : poses.value_or(std::vector<NumberedPose>())) {
    test::require(numbered.T_world_camera.matrix().allFinite(), "poses of a log are finite");
  }
  const auto part = sevenScenesPart(parts[4]);
  test::require(!part || part->number >= 0, "frames are counted from 0");
  for (const DigitRun run : {DigitRun::first, DigitRun::last}) {
    const auto number = numberInName(parts[4], run);
    test::require(!number || *number >= 0, "numbers of files are counted from 0");
  }
  return 0;
}
