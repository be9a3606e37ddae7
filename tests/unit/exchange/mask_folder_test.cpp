#include "core/exchange/mask_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

/// A label image of 6 x 4 pixels with these labels in columns 0 - 2 and 3 - 5.
void writeHalves(const std::filesystem::path& file, int left, int right) {
  cv::Mat labels(4, 6, CV_16UC1, cv::Scalar(left));
  labels.colRange(3, 6) = right;
  std::filesystem::create_directories(file.parent_path());
  ASSERT_TRUE(cv::imwrite(file.string(), labels));
}

constexpr const char* kCoco = R"({
  "images": [{"id": 1, "file_name": "color/000120.jpg", "width": 2, "height": 2},
             {"id": 2, "file_name": "overview.jpg", "width": 2, "height": 2},
             {"id": 3, "file_name": "frame-000125.color.png", "width": 2, "height": 2}],
  "annotations": [{"image_id": 1, "segmentation": {"size": [2, 2], "counts": [0, 2, 2]}},
                  {"image_id": 1, "segmentation": {"size": [2, 2], "counts": [0, 4]}}]})";

std::string failureOfFolder(const std::filesystem::path& folder) {
  const Result<MaskFolder> masks = MaskFolder::open(folder);
  EXPECT_FALSE(masks);
  return masks ? "" : masks.error().message();
}

TEST(MaskFolder, NumbersLabelImagesByTheLastNumberInTheirNames) {
  const TemporaryFolder folder;
  writeHalves(folder / "000120.png", 3, 900);
  writeHalves(folder / "sam2-000125-masks.png", 0, 1);
  folder.write("labels.json", "{}");
  folder.write("notes.txt", "");
  const Result<MaskFolder> masks = MaskFolder::open(folder.path());
  ASSERT_TRUE(masks) << masks.error().message();
  EXPECT_EQ(masks->imageCount(), 2U);
  EXPECT_TRUE(masks->has(120));
  EXPECT_TRUE(masks->has(125));
  EXPECT_FALSE(masks->has(2));
  const Result<ImageMasks> image = masks->masksOfFrame(120);
  ASSERT_TRUE(image) << image.error().message();
  EXPECT_EQ(image->size, cv::Size(6, 4));
  EXPECT_THAT(image->masks, testing::ElementsAre(MaskRuns{0, 12, 12}, MaskRuns{12, 12}));
  EXPECT_THAT(masks->nameOf(120), HasSubstr("000120.png"));
}

TEST(MaskFolder, ReadsACocoFile_WithoutNumberedPngs) {
  const TemporaryFolder folder;
  folder.write("overlay.png", "a picture of somebody");
  folder.write("instances.json", std::string("\xEF\xBB\xBF") + kCoco);
  const Result<MaskFolder> masks = MaskFolder::open(folder.path());
  ASSERT_TRUE(masks) << masks.error().message();
  EXPECT_TRUE(masks->has(120));
  EXPECT_TRUE(masks->has(125));
  const Result<ImageMasks> image = masks->masksOfFrame(120);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->masks.size(), 2U) << "masks may overlap";
  EXPECT_EQ(masks->masksOfFrame(125)->masks.size(), 0U);
  EXPECT_EQ(masks->nameOf(125), "frame-000125.color.png");
}

TEST(MaskFolder, RefusesFolders_WhenTheyHoldNoMasks) {
  const TemporaryFolder folder;
  EXPECT_THAT(failureOfFolder(folder / "missing"), HasSubstr("missing is not a folder"));
  EXPECT_THAT(failureOfFolder(folder.path()), HasSubstr("holds no masks"));
  EXPECT_THAT(failureOfFolder(folder.write("file.json", kCoco)), HasSubstr("is not a folder"));
  folder.write("none/instances.json", R"({"images": [], "annotations": []})");
  EXPECT_THAT(failureOfFolder(folder / "none"), HasSubstr("holds no mask"));
  folder.write("unnumbered/instances.json",
               R"({"images": [{"id": 1, "file_name": "a.png", "width": 1, "height": 1}],
                   "annotations": [{"image_id": 1, "segmentation": {"size": [1, 1], "counts": [0, 1]}}]})");
  EXPECT_THAT(failureOfFolder(folder / "unnumbered"), HasSubstr("has a number"));
}

TEST(MaskFolder, RefusesFolders_WhenImagesAreAmbiguous) {
  const TemporaryFolder folder;
  writeHalves(folder / "twice/000120.png", 1, 2);
  writeHalves(folder / "twice/b-120.png", 1, 2);
  EXPECT_THAT(failureOfFolder(folder / "twice"), HasSubstr("the same number"));
  folder.write("two/a.json", kCoco);
  folder.write("two/b.json", kCoco);
  EXPECT_THAT(failureOfFolder(folder / "two"), HasSubstr("2 JSON files"));
  folder.write("scans/a.json", R"({"images": [{"id": 1, "file_name": "a/1.png", "width": 1, "height": 1},
                                              {"id": 2, "file_name": "b/1.png", "width": 1, "height": 1}],
                                   "annotations": [{"image_id": 1, "segmentation": {"size": [1, 1], "counts": [1]}}]})");
  EXPECT_THAT(failureOfFolder(folder / "scans"), HasSubstr("b/1.png have the same number"));
}

TEST(MaskFolder, NamesTheFile_WhenItIsDamaged) {
  const TemporaryFolder folder;
  writeHalves(folder / "000120.png", 1, 2);
  std::filesystem::resize_file(folder / "000120.png", 40);
  cv::imwrite((folder / "000121.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3)));
  const Result<MaskFolder> masks = MaskFolder::open(folder.path());
  ASSERT_TRUE(masks) << masks.error().message();
  for (const int frame : {120, 121}) {
    const Result<ImageMasks> image = masks->masksOfFrame(frame);
    ASSERT_FALSE(image) << frame;
    EXPECT_THAT(image.error().what, HasSubstr("000" + std::to_string(frame) + ".png"));
  }
  folder.write("coco/instances.json", "{\"images\": [");
  EXPECT_THAT(failureOfFolder(folder / "coco"), HasSubstr("instances.json"));
}

}  // namespace
}  // namespace scantrove
