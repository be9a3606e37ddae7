// Masks of other programs as a COCO file.
#include <numeric>

#include "core/exchange/coco_masks.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

std::string cocoOf(const std::string& segmentation) {
  return R"({"images": [{"id": 1, "file_name": "000120.png", "width": 4, "height": 3}], "annotations": [)"
         R"({"image_id": 1, "segmentation": )" +
         segmentation + "}]}";
}

}  // namespace

std::vector<std::string> seeds() {
  return {cocoOf(R"({"size": [3, 4], "counts": [2, 3, 7]})"), cocoOf(R"({"size": [3, 4], "counts": "237"})"),
          cocoOf("[[1, 0, 3, 0.5, 3, 2], [0, 0, 1, 0, 1, 1]]"), cocoOf("[]"),
          R"({"images": [{"id": 1, "file_name": "a/1.jpg", "width": 2, "height": 2},)"
          R"( {"id": 2, "file_name": "2", "width": 1, "height": 1.0}], "annotations": []})"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const auto masks = CocoMasks::parse({reinterpret_cast<const char*>(data), size}, "m.json");
  if (!masks) {
    test::require(masks.error().what.find("m.json") != std::string::npos, "errors name the file");
    return 0;
  }
  for (std::size_t number = 0; number < masks->imageCount(); ++number) {
    const ImageMasks image = masks->masksOfImage(number);
    const auto pixels = static_cast<std::uint64_t>(image.size.area());
    const cv::Size half((image.size.width + 1) / 2, (image.size.height + 1) / 2);
    for (const MaskRuns& mask : image.masks) {
      test::require(std::accumulate(mask.begin(), mask.end(), std::uint64_t{0}) == pixels,
                    "masks fit their image");
      for (const std::uint32_t pixel : sampledPixels(mask, image.size, half))
        test::require(pixel < static_cast<std::uint32_t>(half.area()), "pixels lie in the image");
    }
  }
  return 0;
}
