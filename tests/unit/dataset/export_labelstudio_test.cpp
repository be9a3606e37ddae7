#include <gtest/gtest.h>

#include <set>

#include "core/dataset/brush_rle.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(LabelStudioExportTest, DatasetFormat::labelstudio);

/// Follows Label Studio's decoder: a stream of bits, highest first.
class BrushDecoder {
 public:
  explicit BrushDecoder(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

  std::vector<std::uint8_t> decode() {
    const std::size_t count = read(32);
    const unsigned word = read(5) + 1;
    unsigned sizes[4];
    for (unsigned& size : sizes) size = read(4) + 1;
    std::vector<std::uint8_t> values;
    while (values.size() < count) {
      const bool is_run = read(1) == 1;
      const std::size_t length = read(sizes[read(2)]) + 1;
      if (is_run) {
        values.insert(values.end(), length, static_cast<std::uint8_t>(read(word)));
      } else {
        for (std::size_t i = 0; i < length; ++i) values.push_back(static_cast<std::uint8_t>(read(word)));
      }
    }
    EXPECT_EQ(values.size(), count);
    return values;
  }

 private:
  unsigned read(unsigned bits) {
    unsigned value = 0;
    for (unsigned i = 0; i < bits; ++i, ++at_)
      value = value << 1U | (bytes_.at(at_ / 8) >> (7 - at_ % 8) & 1U);
    return value;
  }

  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// The alpha channel of a brush.
cv::Mat maskOf(const std::vector<std::uint8_t>& rle, int height, int width) {
  std::vector<std::uint8_t> values = BrushDecoder(rle).decode();
  EXPECT_EQ(values.size(), static_cast<std::size_t>(4 * height * width));
  const cv::Mat rgba(height, width, CV_8UC4, values.data());
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  return alpha;
}

TEST(BrushRle, DecodesToTheMask) {
  cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
  const auto expectDecoded = [&] {
    EXPECT_EQ(cv::norm(maskOf(brushRle(mask), mask.rows, mask.cols), mask, cv::NORM_INF), 0);
  };
  expectDecoded();
  mask.setTo(255);  // one run of more than 2^16 values
  expectDecoded();
  mask.setTo(0);
  cv::circle(mask, {300, 200}, 90, 255, cv::FILLED);
  cv::circle(mask, {300, 200}, 30, 0, cv::FILLED);
  mask.at<std::uint8_t>(0, 0) = mask.at<std::uint8_t>(479, 639) = 255;
  expectDecoded();
  mask = cv::Mat(7, 5, CV_8UC1);
  cv::randu(mask, 0, 2);
  mask *= 255;
  expectDecoded();
}

TEST_F(LabelStudioExportTest, HasTheFiles) {
  EXPECT_EQ(exported().files(),
            (std::vector<std::string>{"images/000000.jpg", "images/000010.jpg", "images/000020.jpg",
                                      "label-config.xml", "labels.json", "tasks.json"}));
  EXPECT_EQ(exported().text("images/000010.jpg"), readText(exported().scene.fileOf(10)));
}

TEST_F(LabelStudioExportTest, TasksHaveTheMasks) {
  const Json tasks = exported().json("tasks.json");
  ASSERT_EQ(tasks.size(), 3U);
  std::set<std::string> ids;
  for (const Json& task : tasks) {
    const int frame = task["data"]["frame"];
    const std::string image = task["data"]["image"];
    ASSERT_TRUE(image.starts_with("/data/local-files/?d=images/"));
    EXPECT_TRUE(std::filesystem::exists(exported().file(image.substr(image.find("images/")))));
    ASSERT_EQ(task["annotations"].size(), 1U);
    const Json& results = task["annotations"][0]["result"];
    ASSERT_EQ(results.size(), 2U);
    for (const Json& result : results) {
      EXPECT_TRUE(ids.insert(result["id"].get<std::string>()).second);
      EXPECT_EQ(result["type"], "brushlabels");
      EXPECT_EQ(result["from_name"], "label");
      EXPECT_EQ(result["to_name"], "image");
      EXPECT_EQ(result["original_width"], 640);
      EXPECT_EQ(result["original_height"], 480);
      EXPECT_EQ(result["value"]["format"], "rle");
      const bool is_ball = result["value"]["brushlabels"] == Json::array({"ball"});
      EXPECT_EQ(result["meta"]["text"], Json::array({is_ball ? "ball" : kBoxName}));
      const cv::Mat mask = maskOf(result["value"]["rle"].get<std::vector<std::uint8_t>>(), 480, 640);
      EXPECT_GE(iou(mask, exported().scene.exactMask(frame, is_ball ? kBall : kBox)), 0.95);
    }
  }
}

TEST(LabelStudioExport, InterfaceHasTheClasses) {
  const Exported exported(DatasetFormat::labelstudio, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].name = "\"big\" <ball>\n";
  });
  const std::string config = exported.text("label-config.xml");
  EXPECT_NE(config.find("<BrushLabels name=\"label\" toName=\"image\">"), std::string::npos) << config;
  EXPECT_NE(config.find("value=\"&#34;big&#34; &#60;ball&#62;&#10;\""), std::string::npos) << config;
  EXPECT_NE(config.find("value=\"box\""), std::string::npos);
}

}  // namespace
}  // namespace scantrove::test
