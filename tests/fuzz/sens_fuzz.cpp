// A .sens file: its header, its index, and the images of its frames.
#include "core/capture/sens_file.h"

#include <spdlog/spdlog.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/fuzz/fuzz_target.h"
#include "tests/support/sens_bytes.h"

namespace scantrove::test {
namespace {

std::string tinySens(int color_coding, int depth_coding) {
  std::vector<unsigned char> png;
  cv::imencode(".png", cv::Mat(6, 8, CV_8UC3, cv::Scalar::all(90)), png);
  const std::string raw_color(8 * 6 * 3, 'c'), raw_depth(8 * 6 * 2, '\x04');
  SensFileBytes sens;
  sens.color_camera = sens.depth_camera = sensCamera(8, 3.5F, 2.5F);
  sens.color_width = sens.depth_width = 8;
  sens.color_height = sens.depth_height = 6;
  sens.color_coding = color_coding;
  sens.depth_coding = depth_coding;
  for (std::uint64_t i = 0; i < 2; ++i) {
    sens.frames.push_back({kSensIdentity, 1'000'000 + 33'333 * i,
                           color_coding == 0 ? raw_color : std::string(png.begin(), png.end()),
                           depth_coding == 0 ? raw_depth : zlibStored(raw_depth)});
  }
  return sens.bytes();
}

}  // namespace

std::vector<std::string> seeds() {
  spdlog::set_level(spdlog::level::off);  // warnings are not tested
  return {tinySens(1, 1), tinySens(0, 0)};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto file = test::rewrite(folder, "input.sens", {reinterpret_cast<const char*>(data), size});
  const auto source = openSensFile(file, {});
  if (!source) {
    test::require(!source.error().what.empty(), "an error has words");
    return 0;
  }
  const auto count = (*source)->info().frame_count;
  test::require(count && *count > 0 && static_cast<std::size_t>(*count) <= size / 96,
                "frames lie in the file");
  for (int i = 0; i < 100; ++i) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return 0;
    if (read.status != FrameRead::Status::frame) continue;
    const Intrinsics& K = (*source)->info().intrinsics;
    test::require(read.frame.depth.size() == cv::Size(K.width, K.height), "depth has the camera's size");
    test::require(!read.frame.T_world_camera || read.frame.T_world_camera->matrix().allFinite(),
                  "poses are finite");
  }
  return 0;
}
