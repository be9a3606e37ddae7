#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/app/scantrove_program.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

constexpr int kThings = 4, kScenes = 4;

/// Patches of random colours, the same for each picture of a thing.
cv::Mat pictureOf(int thing) {
  cv::RNG random(static_cast<std::uint64_t>(thing) * 7919 + 1);
  cv::Mat patches(4, 4, CV_8UC3), picture;
  random.fill(patches, cv::RNG::UNIFORM, 20, 236);
  cv::resize(patches, picture, {80, 80}, 0, 0, cv::INTER_CUBIC);
  return picture;
}

/// Photographs of all things on a table, in another order in each.
void writePhotographs(const TemporaryFolder& folder, const std::string& mapping) {
  for (int scene = 0; scene < kScenes; ++scene) {
    cv::Mat color(480, 640, CV_8UC3, cv::Scalar(90, 110, 130)), depth(480, 640, CV_16UC1, cv::Scalar(1000)),
        labels(480, 640, CV_16UC1, cv::Scalar(0));
    for (int thing = 1; thing <= kThings; ++thing) {
      const cv::Rect box(40 + 150 * ((thing + scene) % kThings), 60 + 50 * scene, 80, 80);
      pictureOf(thing).copyTo(color(box));
      labels(box) = 100 * thing;
    }
    const std::string name = (folder / ("table" + std::string(1, "abcd"[scene]) + "_1")).string();
    cv::imwrite(name + "-color.png", color);
    cv::imwrite(name + "-depth.png", depth);
    cv::imwrite(name + "-label.png", labels);
  }
  if (!mapping.empty()) static_cast<void>(folder.write("label_mapping.csv", mapping));
}

constexpr const char* kMapping = "ID,Instance\r\n1,apple\r\n2,mug\r\n3,book\r\n4,pen, red\r\n";

TEST(EvaluateRecognition, FindsThingsInOtherImages) {
  const TemporaryFolder folder;
  writePhotographs(folder, kMapping);
  const auto json =
      jsonOf(scantrove({"evaluate", "recognition", folder.path(), "--views", "2", "--draws", "2", "--json"}));
  EXPECT_EQ(json["images"], kScenes);
  EXPECT_EQ(json["things"], kThings);
  EXPECT_EQ(json["crops"], kThings * kScenes);
  EXPECT_EQ(json["queries"], 2 * kThings * kScenes);
  EXPECT_EQ(json["nearest_right"], 1);
  EXPECT_EQ(json["at_set_limit"]["named"], 1);
  EXPECT_EQ(json["at_set_limit"]["wrong"], 0);
  EXPECT_EQ(json["at_set_limit"]["unknown_named"], 0);
  EXPECT_EQ(json["each"][3]["name"], "pen, red");
}

TEST(EvaluateRecognition, PrintsText) {
  const TemporaryFolder folder;
  writePhotographs(folder, kMapping);
  const Finished run = scantrove({"evaluate", "recognition", folder.path(), "--draws", "1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* words : {"4 things in 4 images", "nearest right: 1.000", "at most 1 % false names", "mug"})
    EXPECT_THAT(run.out, testing::HasSubstr(words));
}

TEST(EvaluateRecognition, RefusesFoldersWithoutNamesOrQueries) {
  const TemporaryFolder folder;
  writePhotographs(folder, "");
  expectJobFailure(scantrove({"evaluate", "recognition", folder.path()}), {"label_mapping.csv"});
  static_cast<void>(folder.write("label_mapping.csv", "nothing\n"));
  expectJobFailure(scantrove({"evaluate", "recognition", folder.path()}), {"names no things"});
  static_cast<void>(folder.write("label_mapping.csv", kMapping));
  for (int scene = 1; scene < kScenes; ++scene) {
    const std::string name = "table" + std::string(1, "abcd"[scene]) + "_1-depth.png";
    std::filesystem::remove(folder / name);
  }
  expectJobFailure(scantrove({"evaluate", "recognition", folder.path()}), {"two scenes", "--each-image"});
}

TEST(EvaluateRecognition, TakesNumberedImagesAsOneScene) {
  const TemporaryFolder folder;
  writePhotographs(folder, kMapping);
  for (const char* end : {"color", "depth", "label"}) {
    const std::string file = std::string("_1-") + end + ".png";
    std::filesystem::rename(folder / ("tableb" + file), folder / (std::string("tablea_2-") + end + ".png"));
  }
  const auto json =
      jsonOf(scantrove({"evaluate", "recognition", folder.path(), "--views", "4", "--draws", "1", "--json"}));
  EXPECT_EQ(json["queries"], kThings * kScenes);
  const auto each = jsonOf(scantrove(
      {"evaluate", "recognition", folder.path(), "--views", "4", "--draws", "1", "--each-image", "--json"}));
  EXPECT_EQ(each["nearest_right"], 1);
}

}  // namespace
}  // namespace scantrove::test
