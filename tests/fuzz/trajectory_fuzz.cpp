// Trajectories in each format: TUM lines, a .log file, a folder of 7-Scenes poses.
#include <algorithm>

#include "core/capture/trajectory_reader.h"
#include "core/evaluation/trajectory_metrics.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

void check(const std::filesystem::path& path) {
  const auto poses = readTrajectory(path);
  require(poses || poses.error().what.find(path.filename().string()) != std::string::npos,
          "an error names the file");
  if (!poses) return;
  require(!poses->empty(), "a trajectory has poses");
  require(std::ranges::is_sorted(*poses, {}, &StampedPose::timestamp_s), "poses are ordered by time");
  for (const StampedPose& pose : *poses) {
    require(pose.T_world_camera.matrix().allFinite() && std::isfinite(pose.timestamp_s), "poses are finite");
    require(std::abs(pose.T_world_camera.linear().determinant() - 1) < 1e-3, "poses are rigid");
  }
  const auto pairs = associate(*poses, *poses);
  if (pairs.size() < 2) return;
  (void)absoluteTrajectoryError(pairs);
  (void)relativePoseError(pairs, 1);
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      "# poses\n1.0 0 0 0 0 0 0 1\n1.02 0.1 0.2 0.3 0 0 0.7 0.7\n1.2 1 2 3 0.5 0.5 0.5 0.5\n",
      "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\n1305031098.6759 1 0 0 0 0 0 1\n",
      "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n3 3 4\n0 -1 0 7\n1 0 0 0\n0 0 1 0\n0 0 0 1\n",
      "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const std::string text(reinterpret_cast<const char*>(data), size);
  test::check(test::rewrite(folder, "poses.txt", text));
  test::check(test::rewrite(folder, "poses.log", text));
  std::filesystem::create_directories(folder / "seq");
  test::rewrite(folder, "seq/frame-000003.pose.txt", text);
  test::check(folder / "seq");
  return 0;
}
