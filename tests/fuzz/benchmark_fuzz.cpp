// Text files of benchmarks: scene_camera.json of BOP; cam_params.json and traj.txt of Replica; info.txt of
// BundleFusion. Four parts, each with one or two images.
#include <spdlog/spdlog.h>

#include <opencv2/imgcodecs.hpp>

#include "core/capture/bop_scene.h"
#include "core/capture/replica_folder.h"
#include "core/capture/rig_info.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

void writeSample(const std::filesystem::path& file, int type) {
  std::filesystem::create_directories(file.parent_path());
  require(cv::imwrite(file.string(), cv::Mat(12, 16, type, cv::Scalar::all(90))),
          "the test can write its images");
}

const TemporaryFolder& folder() {
  static const TemporaryFolder with_images;
  static const bool is_filled = [] {
    spdlog::set_level(spdlog::level::off);  // warnings are not tested
    for (const char* const name : {"000000.png", "000007.png"}) {
      writeSample(with_images / ("bop/depth/" + std::string(name)), CV_16UC1);
      writeSample(with_images / ("bop/rgb/" + std::string(name)), CV_8UC3);
    }
    writeSample(with_images / "replica/results/depth000000.png", CV_16UC1);
    writeSample(with_images / "replica/results/frame000000.png", CV_8UC3);
    return true;
  }();
  require(is_filled, "the folders are there");
  return with_images;
}

void readAll(const Result<std::unique_ptr<FrameSource>>& source) {
  require(source || !source.error().what.empty(), "an error has words");
  while (source) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return;
    require(!read.frame.T_world_camera || read.frame.T_world_camera->matrix().allFinite(),
            "poses are finite");
  }
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      R"({"0": {"cam_K": [16, 0, 7.5, 0, 16, 5.5, 0, 0, 1], "depth_scale": 0.1,)"
      R"( "cam_R_w2c": [0, -1, 0, 1, 0, 0, 0, 0, 1], "cam_t_w2c": [100, 200, 300]},)"
      R"( "7": {"cam_K": [17, 0, 7.5, 0, 17, 5.5, 0, 0, 1], "depth_scale": 1.0}})"
      "\x1E"
      R"({"camera": {"w": 16, "h": 12, "fx": 16, "fy": 16, "cx": 7.5, "cy": 5.5, "scale": 6553.5}})"
      "\x1E"
      "1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1\n\x1E"
      "m_colorWidth = 16\nm_colorHeight = 12\nm_depthWidth = 16\nm_depthHeight = 12\nm_depthShift = 1000\n"
      "m_calibrationColorIntrinsic = 16 0 7.5 0 0 16 5.5 0 0 0 1 0 0 0 0 1\n"
      "m_calibrationColorExtrinsic = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"
      "m_calibrationDepthIntrinsic = 16 0 7.5 0 0 16 5.5 0 0 0 1 0 0 0 0 1\n"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const auto parts = test::partsOf({reinterpret_cast<const char*>(data), size}, 4);
  const test::TemporaryFolder& folder = test::folder();
  test::rewrite(folder, "bop/scene_camera.json", parts[0]);
  test::rewrite(folder, "replica/cam_params.json", parts[1]);
  test::rewrite(folder, "replica/traj.txt", parts[2]);
  const auto info = test::rewrite(folder, "info.txt", parts[3]);
  test::readAll(openBopScene(folder / "bop", {}));
  test::readAll(openReplicaFolder(folder / "replica", {}));
  const auto camera = readRigInfo(info);
  test::require(camera || camera.error().what.find("info.txt") != std::string::npos, "errors name the file");
  return 0;
}
