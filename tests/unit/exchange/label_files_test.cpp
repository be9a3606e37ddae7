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
  ASSERT_TRUE(writeLabelImage(folder / "000007.png", labels, 3, 2, {3, 2}));
  const auto image = readLabelImage(folder / "000007.png");
  ASSERT_TRUE(image);
  ASSERT_EQ(image->type(), CV_16UC1);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(image->at<std::uint16_t>(i / 3, i % 3), labels[static_cast<std::size_t>(i)]);
  }
}

TEST(LabelImage, DoublesByRepeatingAndHandlesOddSizes) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> labels{1, 2, 3, 4};
  ASSERT_TRUE(writeLabelImage(folder / "a.png", labels, 2, 2, {4, 4}));
  const cv::Mat doubled = *readLabelImage(folder / "a.png");
  const cv::Mat expected = (cv::Mat_<std::uint16_t>(4, 4) << 1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 4, 4, 3, 3, 4, 4);
  EXPECT_EQ(cv::norm(doubled, expected, cv::NORM_INF), 0);

  ASSERT_TRUE(writeLabelImage(folder / "b.png", labels, 2, 2, {5, 3}));
  const cv::Mat odd = *readLabelImage(folder / "b.png");
  // Pixel i of n covers [i, i + 1) / n; its centre falls into the input pixel that covers it.
  const cv::Mat expected_odd = (cv::Mat_<std::uint16_t>(3, 5) << 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 3, 3, 4, 4, 4);
  EXPECT_EQ(cv::norm(odd, expected_odd, cv::NORM_INF), 0);
}

TEST(LabelImage, RefusesAnIdThatDoesNotFit) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> labels{0, 65536};
  const auto result = writeLabelImage(folder / "a.png", labels, 2, 1, {2, 1});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("65536"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(LabelImage, ReadingSaysWhatIsWrong) {
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

TEST(LabelMap, MapsRegionsToColourObjectAndName) {
  const TemporaryFolder folder;
  const std::vector<LabelMapEntry> entries{{RegionId{3}, {10, 20, 30}, ObjectId{7}, "M\xC3\xBCsli \"box\""},
                                           {RegionId{12}, {1, 2, 3}, {}, ""},
                                           {RegionId{13}, {1, 2, 3}, ObjectId{8}, "not utf-8 \xff"}};
  ASSERT_TRUE(writeLabelMap(folder / "labels.json", entries));
  const auto map = nlohmann::json::parse(test::readText(folder / "labels.json"));
  EXPECT_EQ(map.size(), 3U);
  EXPECT_EQ(map["3"]["color"], (std::vector<int>{10, 20, 30}));
  EXPECT_EQ(map["3"]["object"], 7);
  EXPECT_EQ(map["3"]["name"], "M\xC3\xBCsli \"box\"");
  EXPECT_TRUE(map["12"]["object"].is_null());
  EXPECT_TRUE(map["12"]["name"].is_null());
  ASSERT_TRUE(writeLabelMap(folder / "empty.json", {}));
  EXPECT_TRUE(nlohmann::json::parse(test::readText(folder / "empty.json")).is_object());
}

TEST(RegionPalette, GivesNeighbouringRegionsColoursThatDiffer) {
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
