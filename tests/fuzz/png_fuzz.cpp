// PNG as colour and as depth. Checksums stop most mutations, so each input is also tried with valid
// checksums.
#include <libdeflate.h>

#include <opencv2/imgcodecs.hpp>

#include "core/image/image_file.h"
#include "core/image/image_header.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

/// The input with a valid checksum in each chunk.
std::string withChecksums(std::string png) {
  constexpr std::size_t kSignature = 8, kFrame = 12;
  for (std::size_t at = kSignature; png.size() >= at + kFrame;) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(png[at + i]);
    if (length > png.size() - at - kFrame) break;
    const std::uint32_t sum = libdeflate_crc32(0, png.data() + at + 4, length + 4);
    for (std::size_t i = 0; i < 4; ++i) png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += kFrame + length;
  }
  return png;
}

void decode(std::string_view png) {
  const auto size = imageSize(bytesOf(png));
  for (const bool is_depth : {false, true}) {
    const auto image =
        is_depth ? decodeDepthImage(bytesOf(png), "input") : decodeColorImage(bytesOf(png), "input");
    if (!image) {
      require(image.error().what.starts_with("input "), "errors name the file");
      continue;
    }
    require(image->type() == (is_depth ? CV_16UC1 : CV_8UC3), "an image has its type");
    require(
        size && image->cols == static_cast<int>(size->width) && image->rows == static_cast<int>(size->height),
        "an image has the size of its header");
  }
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> all;
  for (const int type : {CV_16UC1, CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC3}) {
    cv::Mat image(13, 17, type);
    cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 4000);
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes);
    all.emplace_back(bytes.begin(), bytes.end());
  }
  return all;
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  scantrove::test::decode(input);
  scantrove::test::decode(scantrove::test::withChecksums(input));
  return 0;
}
