// Painted pixels of a session: two bytes for width and height, then the runs.
#include "core/editing/painted_pixels.h"

#include <opencv2/core.hpp>

#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {std::string("\x05\x03\x04\x02\x06\x01", 6), std::string("\x02\x03\x00\x06", 4),
          std::string("\xFF\xFF\xAC\x02\x05", 5), std::string("\x09\x09", 2)};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  if (size < 2) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  const auto pixels = PaintedPixels::fromBytes(data[0], data[1], bytes);
  if (!pixels) return 0;
  const cv::Mat mask = pixels->mask();
  test::require(mask.cols == data[0] && mask.rows == data[1], "the mask has the size of the image");
  const PaintedPixels again = PaintedPixels::of(mask);
  test::require(again == *pixels, "runs are those of the mask");
  test::require(PaintedPixels::fromBytes(data[0], data[1], again.toBytes()) == *pixels,
                "what is read can be written");
  return 0;
}
