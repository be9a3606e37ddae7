#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "core/exchange/label_image_writer.h"
#include "core/exchange/label_map_writer.h"
#include "core/exchange/region_palette.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;

TEST(LabelImage, KeepsAllSixteenBits) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> labels{0, 1, 255, 256, 40000, 65535};
  ASSERT_TRUE(writeLabelImage(folder / "000007.png", labels, {3, 2}));
  const auto image = readLabelImage(folder / "000007.png");
  ASSERT_TRUE(image);
  ASSERT_EQ(image->type(), CV_16UC1);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(image->at<std::uint16_t>(i / 3, i % 3), labels[static_cast<std::size_t>(i)]);
  }
}

TEST(LabelImage, ReadsBackEqual_WhenSizesAndPatternsDiffer) {
  const TemporaryFolder folder;
  cv::RNG random(5);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 7), cv::Size(9, 1), cv::Size(53, 37)}) {
    for (const bool is_noise : {false, true}) {
      cv::Mat_<int> requested(size);
      if (is_noise) {
        random.fill(requested, cv::RNG::UNIFORM, 0, 65536);
      } else {
        requested = 7;
        requested(cv::Rect(size.width / 2, size.height / 2, 1 + size.width / 4, 1 + size.height / 4) &
                  cv::Rect({0, 0}, size)) = 300;
      }
      const std::vector<std::uint32_t> labels(requested.begin(), requested.end());
      ASSERT_TRUE(writeLabelImage(folder / "a.png", labels, size));
      const auto image = readLabelImage(folder / "a.png");
      ASSERT_TRUE(image) << image.error().message();
      ASSERT_EQ(image->type(), CV_16UC1);
      cv::Mat read;
      image->convertTo(read, CV_32S);
      EXPECT_EQ(cv::norm(read, requested, cv::NORM_INF), 0) << size << (is_noise ? " noise" : "");
      const std::string first = test::readText(folder / "a.png");
      ASSERT_TRUE(writeLabelImage(folder / "b.png", labels, size));
      EXPECT_EQ(first, test::readText(folder / "b.png"));
    }
  }
}

TEST(LabelImage, RefusesAnId_WhenItExceedsSixteenBits) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> labels{0, 65536};
  const auto result = writeLabelImage(folder / "a.png", labels, {2, 1});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("65536"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(LabelImage, NamesTheFile_WhenItIsNoLabelImage) {
  const TemporaryFolder folder;
  EXPECT_NE(readLabelImage(folder / "none.png").error().what.find("none.png"), std::string::npos);
  const auto text = readLabelImage(folder.write("text.png", "not an image"));
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().what.find("text.png"), std::string::npos);
  cv::imwrite((folder / "color.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3)));
  const auto color = readLabelImage(folder / "color.png");
  ASSERT_FALSE(color);
  EXPECT_NE(color.error().what.find("color.png"), std::string::npos);
}

TEST(LabelMap, MapsRegionsToColorObjectAndName) {
  const TemporaryFolder folder;
  const std::vector<LabelMapEntry> entries{{RegionId{3}, {10, 20, 30}, ObjectId{7}, "M\xC3\xBCsli \"box\""},
                                           {RegionId{12}, {1, 2, 3}, {}, "", "", false, 7, -1.5F},
                                           {RegionId{13}, {1, 2, 3}, ObjectId{8}, "not utf-8 \xff"}};
  ASSERT_TRUE(writeLabelMap(folder / "labels.json", entries));
  const auto map = nlohmann::json::parse(test::readText(folder / "labels.json"));
  EXPECT_EQ(map.size(), 3U);
  EXPECT_EQ(map["3"]["color"], (std::vector<int>{10, 20, 30}));
  EXPECT_EQ(map["3"]["object"], 7);
  EXPECT_EQ(map["3"]["name"], "M\xC3\xBCsli \"box\"");
  EXPECT_TRUE(map["12"]["object"].is_null());
  EXPECT_TRUE(map["12"]["name"].is_null());
  EXPECT_EQ(map["12"]["image_label"], 7) << "label images hold 16 bits";
  EXPECT_FALSE(map["3"].contains("image_label")) << "it equals the id";
  EXPECT_EQ(map["12"]["objectness"], -1.5);
  EXPECT_FALSE(map["3"].contains("objectness")) << "it was not rated";
  ASSERT_TRUE(writeLabelMap(folder / "empty.json", {}));
  EXPECT_TRUE(nlohmann::json::parse(test::readText(folder / "empty.json")).is_object());
}

TEST(RegionPalette, SeparatesColorsOfNeighboringIds) {
  EXPECT_EQ(regionColor(RegionId{5}), regionColor(RegionId{5}));
  std::set<std::array<std::uint8_t, 3>> colors;
  for (std::uint32_t id = 0; id < 200; ++id) {
    const auto a = regionColor(RegionId{id});
    const auto b = regionColor(RegionId{id + 1});
    colors.insert(a);
    EXPECT_GT(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]), 60) << id;
  }
  EXPECT_GT(colors.size(), 195U);
}

}  // namespace
}  // namespace scantrove
