// JPEG, and formats that OpenCV decodes (PNM, BMP, TIFF), as colour and as depth.
#include <opencv2/imgcodecs.hpp>

#include "core/image/color_bytes.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/oriented_image.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  std::vector<std::string> all;
  for (const char* format : {".jpg", ".ppm", ".pgm", ".bmp", ".tif"}) {
    for (const int type : {CV_8UC3, CV_8UC1, CV_16UC1}) {
      const bool is_8_bit_only = std::string_view(format) == ".jpg" || std::string_view(format) == ".bmp";
      if (type == CV_16UC1 && is_8_bit_only) continue;
      if ((std::string_view(format) == ".pgm") != (type != CV_8UC3) && std::string_view(format)[1] == 'p')
        continue;
      cv::Mat image(23, 29, type);
      cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 4000);
      std::vector<unsigned char> bytes;
      cv::imencode(format, image, bytes);
      all.emplace_back(bytes.begin(), bytes.end());
    }
  }
  all.push_back(withExif(all.front(), true, 6));
  return all;
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const auto color = decodeColorImage({data, size}, "input");
  test::require(color ? color->type() == CV_8UC3 : color.error().what.starts_with("input "),
                "a colour image has its type, an error names the file");
  const auto depth = decodeDepthImage({data, size}, "input");
  test::require(depth ? depth->type() == CV_16UC1 : depth.error().what.starts_with("input "),
                "a depth image has its type, an error names the file");
  for (const auto& image : {color, depth}) {
    test::require(!image || image->total() <= kMaxImagePixels, "no image exceeds the limit");
  }
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string upright = withoutOrientation(bytes);
  test::require(upright.size() <= bytes.size() && withoutOrientation(upright) == upright,
                "clearing an orientation is idempotent and adds no bytes");
  test::require(!isPlainColor({data, size}) || imageFormat({data, size}), "a plain image has a format");
  return 0;
}
