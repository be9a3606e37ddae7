// The three lists of a TUM RGB-D folder with one depth and one colour image.
#include <spdlog/spdlog.h>

#include <opencv2/imgcodecs.hpp>

#include "core/capture/trajectory_reader.h"
#include "core/capture/tum_folder.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

const TemporaryFolder& folder() {
  static const TemporaryFolder with_images;
  static const bool is_filled =
      cv::imwrite(with_images / "d.png", cv::Mat(12, 16, CV_16UC1, cv::Scalar(5000))) &&
      cv::imwrite(with_images / "c.png", cv::Mat(12, 16, CV_8UC3, cv::Scalar::all(90)));
  require(is_filled, "the test can write its images");
  spdlog::set_level(spdlog::level::off);  // warnings are not tested
  return with_images;
}

void readAll(FrameSource& source) {
  constexpr int kMaxFrames = 100;  // a mutation may name the images many times
  for (int i = 0; i < kMaxFrames; ++i) {
    const FrameRead read = source.next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return;
    const bool is_frame = read.status == FrameRead::Status::frame;
    require(is_frame ? !read.frame.depth.empty() : !read.error.what.empty(),
            "a frame has depth, an error has words");
    require(!read.frame.T_world_camera || read.frame.T_world_camera->matrix().allFinite(),
            "poses are finite");
  }
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      "# depth\n1.00 d.png\n1.03 d.png\n1.07 d.png\n\x1E# color\n1.01 c.png\n1.04 c.png\n\x1E"
      "# poses\n1.0 0 0 0 0 0 0 1\n1.02 0.1 0.2 0.3 0 0 0.7 0.7\n1.2 1 2 3 0.5 0.5 0.5 0.5\n",
      "1305031102.160407 d.png\n\x1E"
      "1305031102.175304 c.png\n\x1E"
      "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\n"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const auto parts = test::partsOf({reinterpret_cast<const char*>(data), size}, 3);
  const test::TemporaryFolder& folder = test::folder();
  test::rewrite(folder, "depth.txt", parts[0]);
  test::rewrite(folder, "rgb.txt", parts[1]);
  test::rewrite(folder, "groundtruth.txt", parts[2]);
  const auto source = openTumFolder(folder.path(), {});
  test::require(source || !source.error().what.empty(), "an error has words");
  if (source) test::readAll(**source);
  const auto poses = readTrajectory(folder / "groundtruth.txt");
  test::require(!poses || !poses->empty(), "a trajectory has poses");
  return 0;
}
