// nyu_depth_v2_labeled.mat, a small one of the same layout.
#include "core/evaluation/nyu_labeled_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/nyu_labeled_writer.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  const TemporaryFolder folder;
  std::vector<LabeledImage> images;
  for (int i = 0; i < 2; ++i) {
    const std::string file = "study_0001a/d-1.5-" + std::to_string(i) + ".pgm";
    images.push_back({"study_0001", file, cv::Mat1w(6, 8, static_cast<std::uint16_t>(i + 1)),
                      cv::Mat1b(6, 8, std::uint8_t{1}), cv::Mat1f(6, 8, 2.5F)});
  }
  NyuLabeledWriter::write(folder / "labeled.mat", images);
  return {readText(folder / "labeled.mat")};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto path = test::rewrite(folder, "labeled.mat", {reinterpret_cast<const char*>(data), size});
  const auto file = NyuLabeledFile::open(path);
  test::require(file || file.error().what.find(path.string()) != std::string::npos,
                "an error names the file");
  if (!file) return 0;
  test::require(!file->origins().empty() && file->imageSize().area() > 0, "an accepted file has images");
  const std::size_t images = std::min<std::size_t>(file->origins().size(), 3);
  for (std::size_t i = 0; i < images; ++i) {
    const auto labels = file->labels(i), instances = file->instances(i);
    const auto depth = file->depth(i);
    test::require(!labels || labels->size() == file->imageSize(), "labels have the size of an image");
    test::require(!instances || instances->size() == file->imageSize(),
                  "instances have the size of an image");
    test::require(!depth || depth->size() == file->imageSize(), "depth has the size of an image");
  }
  return 0;
}
