// Ground truth of `evaluate`: label images by the numbers in their names, and instances.json.
#include <opencv2/imgcodecs.hpp>

#include "app/true_objects.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

std::string labelPng(int type) {
  cv::Mat image(6, 8, type, cv::Scalar(0));
  image(cv::Rect(2, 1, 3, 3)).setTo(cv::Scalar(7));
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string plainName(const std::string& requested) {
  std::string name;
  for (const char c : requested.substr(0, 60)) {
    if (c != '/' && c != '\0') name += c;
  }
  return name.empty() || name == "." || name == ".." ? "x" : name;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string list =
      R"([{"id": 7, "name": "mug", "object": true, "extent_m": 0.1}, {"id": 2, "name": "wall", "object": false}])";
  return {"frame-000012.instance.png\x1E" + list + "\x1E" + labelPng(CV_16UC1),
          "img-3-label.png\x1E" + list + "\x1E" + labelPng(CV_8UC1), "7.png\x1E[]\x1E" + labelPng(CV_8UC3)};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto parts = test::partsOf({reinterpret_cast<const char*>(data), size}, 2);
  const std::size_t image_at = parts[0].size() + parts[1].size() + 2;
  const std::string image(reinterpret_cast<const char*>(data) + std::min(size, image_at),
                          size - std::min(size, image_at));
  const std::filesystem::path truth = folder / "truth";
  std::filesystem::remove_all(truth);
  folder.write("truth/instances.json", parts[1]);
  folder.write("truth/" + test::plainName(parts[0]), image);
  const auto images = numberedImages(truth);
  test::require(images || !images.error().what.empty(), "an error has words");
  const auto scene = readTrueScene(truth, [](long) { return true; });
  test::require(scene || !scene.error().what.empty(), "an error has words");
  if (!scene) return 0;
  for (const auto& [number, path] : scene->images) {
    test::require(number >= 0, "frames are counted from 0");
    const auto metrics = evaluateLabelImage(path, cv::Mat(6, 8, CV_16UC1, cv::Scalar(1)), {});
    test::require(metrics || !metrics.error().what.empty(), "an error has words");
  }
  for (const auto& [id, object] : scene->objects)
    test::require(std::isfinite(object.extent_m) && object.extent_m >= 0, "objects have a size");
  return 0;
}
