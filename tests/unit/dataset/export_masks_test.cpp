#include <gtest/gtest.h>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

std::set<int> valuesIn(const cv::Mat& mask) {
  return {mask.begin<std::uint16_t>(), mask.end<std::uint16_t>()};
}

TEST(MasksExport, HasRegionIdsOfSixteenBits) {
  const Exported exported(DatasetFormat::masks, [](ScannedScene& scene) { scene.frames = 2; });
  EXPECT_EQ(exported.files(), (std::vector<std::string>{"color/000000.jpg", "color/000010.jpg", "labels.json",
                                                        "masks/000000.png", "masks/000010.png"}));
  const cv::Mat mask = exported.image("masks/000010.png");
  ASSERT_EQ(mask.type(), CV_16UC1);
  EXPECT_EQ(mask.size(), cv::Size(640, 480));
  EXPECT_EQ(valuesIn(mask), (std::set<int>{0, kBox, kBall}));
  for (const std::uint32_t id : {kBox, kBall})
    EXPECT_GE(iou(mask == static_cast<int>(id), exported.scene.exactMask(10, id)), 0.95);
  const Json labels = exported.json("labels.json");
  EXPECT_EQ(labels["12"]["name"], kBoxName);
  EXPECT_EQ(labels["12"]["category"], "box");
  EXPECT_EQ(labels["12"]["object"], 3);
  EXPECT_TRUE(labels["40"]["category"].is_null());
  EXPECT_EQ(labels.size(), 2U);
}

TEST(MasksExport, NumbersRegions_WhenTheirIdsExceedSixteenBits) {
  const Exported exported(DatasetFormat::masks, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[4].id = 70000;  // no region in view
    scene.labels[4].name = "late";
  });
  const Json labels = exported.json("labels.json");
  EXPECT_EQ(labels["1"]["region"], kBox);
  EXPECT_EQ(labels["2"]["region"], kBall);
  EXPECT_EQ(labels["3"]["region"], 70000);
  EXPECT_EQ(valuesIn(exported.image("masks/000000.png")), (std::set<int>{0, 1, 2}));
}

TEST(MasksExport, HasTheSizeOfDepth_WithoutColor) {
  const Exported exported(DatasetFormat::masks, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.without_color = {0};
  });
  EXPECT_EQ(exported.files(), (std::vector<std::string>{"labels.json", "masks/000000.png"}));
  EXPECT_EQ(exported.image("masks/000000.png").size(), cv::Size(320, 240));
}

TEST(MasksExport, IncludesBackgroundAndRejectedRegions_WhenRequested) {
  const Exported exported(
      DatasetFormat::masks, [](ScannedScene& scene) { scene.frames = 1; }, true);
  const auto values = valuesIn(exported.image("masks/000000.png"));
  for (const std::uint32_t id : {kTable, kBlock}) EXPECT_TRUE(values.contains(static_cast<int>(id)));
  EXPECT_EQ(exported.json("labels.json")["7"]["background"], true);
}

}  // namespace
}  // namespace scantrove::test
