// Depth images of any type: NumPy arrays, float TIFF, PGM.
#include "core/capture/depth_file.h"

#include <opencv2/imgcodecs.hpp>

#include <cmath>

#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

std::string numpySeed(const std::string& type, std::size_t bytes_each) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (3, 4), }";
  header.resize(117, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
         std::string(12 * bytes_each, '\x3F');
}

std::string tiffSeed() {
  std::vector<unsigned char> bytes;
  cv::imencode(".tiff", cv::Mat(3, 4, CV_32FC1, cv::Scalar(1.5)), bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::string> seeds() {
  return {numpySeed("<f4", 4), numpySeed(">f8", 8), numpySeed("<u2", 2), tiffSeed(),
          "P5\n4 3\n65535\n" + std::string(24, '\x04')};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto file = test::rewrite(folder, "input.depth", {reinterpret_cast<const char*>(data), size});
  const auto depth = readAnyDepth(file);
  if (!depth) {
    test::require(depth.error().what.find("input.depth") != std::string::npos, "errors name the file");
    return 0;
  }
  test::require(depth->type() == CV_16UC1 || depth->type() == CV_32FC1, "depth has one of two types");
  if (depth->type() == CV_16UC1) return 0;
  for (int y = 0; y < depth->rows; ++y) {
    for (int x = 0; x < depth->cols; ++x)
      test::require(std::isfinite(depth->at<float>(y, x)) && depth->at<float>(y, x) >= 0,
                    "depths are finite");
  }
  return 0;
}
