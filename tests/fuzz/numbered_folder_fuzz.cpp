// A folder of numbered images; each line of the input is a file name.
#include <spdlog/spdlog.h>

#include <opencv2/imgcodecs.hpp>

#include "core/capture/numbered_folder.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

constexpr std::size_t kMaxFiles = 12, kLongestName = 80;

const std::string& png(int type) {
  static const auto encode = [](int of_type) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", cv::Mat(12, 16, of_type, cv::Scalar::all(90)), bytes);
    return std::string(bytes.begin(), bytes.end());
  };
  static const std::string depth = encode(CV_16UC1), color = encode(CV_8UC3);
  return type == CV_16UC1 ? depth : color;
}

/// A path inside the recording folder, at most one folder deep.
std::string safePath(std::string_view line) {
  std::string path;
  bool has_folder = false;
  for (const char c : line.substr(0, kLongestName)) {
    if (c == '\0' || (c == '/' && std::exchange(has_folder, true))) continue;
    path += c;
  }
  while (path.starts_with('/') || path.starts_with('.')) path.erase(0, 1);
  return path.find("..") != std::string::npos || path.empty() || path.ends_with('/') ? "x" : path;
}

void readAll(FrameSource& source) {
  for (;;) {
    const FrameRead read = source.next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return;
    require(read.status != FrameRead::Status::frame || read.frame.index >= 0, "frames are counted from 0");
  }
}

}  // namespace

std::vector<std::string> seeds() {
  spdlog::set_level(spdlog::level::off);  // warnings are not tested
  return {"depth/000000.png\ndepth/000001.png\ncolor/000000.png\ncolor/000001.png\n",
          "depth/0000001-000000000000.png\ndepth/0000002-000000033333.png\nimage/0000001-000000000000.png\n",
          "depth/12.png\nrgb/12.png\nrgb/13.png\ntrajectory.log\nintrinsic.json\n",
          "depth/1403715273262142976.png\nrgb/1403715273262142976.png\n"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const std::filesystem::path recording = folder / "recording";
  std::error_code ignored;
  std::filesystem::remove_all(recording, ignored);
  std::filesystem::create_directories(recording / "depth");
  std::string_view lines(reinterpret_cast<const char*>(data), size);
  for (std::size_t i = 0; i < test::kMaxFiles && !lines.empty(); ++i) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
    const std::string path = test::safePath(line);
    const std::filesystem::path parent = (recording / path).parent_path();
    std::filesystem::create_directories(parent, ignored);
    if (!ignored)
      std::ofstream(recording / path, std::ios::binary)
          << test::png(path.starts_with("depth") ? CV_16UC1 : CV_8UC3);
  }
  const auto source = openNumberedFolder(recording, {});
  test::require(source || !source.error().what.empty(), "an error has words");
  if (source) test::readAll(**source);
  return 0;
}
