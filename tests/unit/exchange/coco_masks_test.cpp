#include "core/exchange/coco_masks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A file with one image of 4 x 3 pixels (id 5) and one annotation.
std::string cocoFile(const std::string& segmentation, const std::string& image = "") {
  const std::string of_file = R"({"id": 5, "file_name": "rgb/000120.jpg", "width": 4, "height": 3})";
  return R"({"images": [)" + (image.empty() ? of_file : image) +
         R"(], "annotations": [{"id": 1, "image_id": 5, "segmentation": )" + segmentation + "}]}";
}

/// The masks of the file's image.
std::vector<MaskRuns> runsIn(const std::string& segmentation) {
  const Result<CocoMasks> masks = CocoMasks::parse(cocoFile(segmentation), "m.json");
  EXPECT_TRUE(masks) << masks.error().message();
  return masks ? masks->masksOfImage(0).masks : std::vector<MaskRuns>{};
}

std::string failureOf(const std::string& file) {
  const Result<CocoMasks> masks = CocoMasks::parse(file, "m.json");
  EXPECT_FALSE(masks) << file;
  return masks ? "" : masks.error().message();
}

TEST(CocoMasks, ReadsRunLengthsAsTextAndAsNumbers) {
  const Result<CocoMasks> masks =
      CocoMasks::parse(cocoFile(R"({"size": [3, 4], "counts": [2, 3, 7]})"), "m.json");
  ASSERT_TRUE(masks) << masks.error().message();
  ASSERT_EQ(masks->imageCount(), 1U);
  EXPECT_EQ(masks->fileName(0), "rgb/000120.jpg");
  EXPECT_TRUE(masks->hasMasks(0));
  EXPECT_EQ(masks->masksOfImage(0).size, cv::Size(4, 3));
  EXPECT_THAT(masks->masksOfImage(0).masks, ElementsAre(MaskRuns{2, 3, 7}));
  EXPECT_THAT(runsIn(R"({"size": [3.0, 4.0], "counts": "237"})"), ElementsAre(MaskRuns{2, 3, 7}));
}

// COCO counts from the corner of the first pixel: the square covers columns 1 and 2 of rows 0 and 1.
TEST(CocoMasks, PolygonsAddTheirInsides) {
  const std::string square = "[1, 0, 3, 0, 3, 2, 1, 2]";
  const std::vector<MaskRuns> masks = runsIn("[" + square + "]");
  ASSERT_EQ(masks.size(), 1U);
  const auto pixels = sampledPixels(masks.front(), {4, 3}, {4, 3});
  EXPECT_THAT(pixels, ElementsAre(1, 2, 5, 6));
  EXPECT_EQ(runsIn("[" + square + ", " + square + "]"), masks) << "equal polygons do not cancel out";
}

// The upper side is y = x + 0.2: below it lie the centres of rows 1 and 2 in column 0, and of row 2 in
// column 1.
TEST(CocoMasks, PolygonHoldsThePixelsWhoseCentersLieWithin) {
  const std::vector<MaskRuns> masks = runsIn("[[-0.1, 0.1, -0.1, 9, 2.9, 9, 2.9, 3.1]]");
  ASSERT_EQ(masks.size(), 1U);
  EXPECT_THAT(sampledPixels(masks.front(), {4, 3}, {4, 3}), ElementsAre(4, 8, 9));
}

TEST(CocoMasks, PolygonOutsideOfTheImageIsNoMask) {
  EXPECT_THAT(runsIn("[[1e30, 1e30, 1e30, 2e30, 2e30, 1e30]]"), IsEmpty());
}

TEST(CocoMasks, LeavesOutAnnotationsWithoutASegmentation) {
  for (const char* nothing : {"null", "[]"}) {
    const Result<CocoMasks> masks = CocoMasks::parse(cocoFile(nothing), "m.json");
    ASSERT_TRUE(masks) << masks.error().message();
    EXPECT_FALSE(masks->hasMasks(0));
  }
  EXPECT_TRUE(CocoMasks::parse(R"({"images": [], "annotations": [{"bbox": [0, 0, 1, 1]}]})", "m.json"));
}

TEST(CocoMasks, MaskWithoutPixelsIsLeftOut) {
  EXPECT_THAT(runsIn(R"({"size": [3, 4], "counts": [12]})"), IsEmpty());
  EXPECT_THAT(runsIn(R"({"size": [3, 4], "counts": [12, 0]})"), IsEmpty());
}

TEST(CocoMasks, RefusesRunLengths_WhenTheyDoNotFit) {
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [3, 4], "counts": [2, 3, 6]})")),
              testing::AllOf(HasSubstr("000120.jpg"), HasSubstr("m.json"), HasSubstr("11 pixels")));
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [4, 3], "counts": [2, 3, 7]})")), HasSubstr("3 x 4 pixels"));
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [3, 4], "counts": [-2, 3, 11]})")), HasSubstr("a run of -2"));
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [3, 4], "counts": "2 7"})")), HasSubstr("no run-length code"));
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [3, 4], "counts": [9999999999, 1]})")), HasSubstr("9999999999"));
  // Their sum is 12 modulo 2^32.
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [3, 4], "counts": [2147483647, 2147483647, 14]})")),
              HasSubstr("4294967308 pixels"));
}

TEST(CocoMasks, RefusesPolygons_WithoutThreeCorners) {
  for (const char* polygon : {"[[1, 1, 2, 2]]", "[[1, 1, 2, 2, 3]]", "[1, 1, 2, 2, 3, 3]", R"([{"x": 1}])"})
    EXPECT_THAT(failureOf(cocoFile(polygon)), HasSubstr("three corners")) << polygon;
}

TEST(CocoMasks, RefusesImages_WhenTheirSizeIsMissingOrImpossible) {
  const std::string mask = R"({"size": [3, 4], "counts": [12]})";
  EXPECT_THAT(failureOf(cocoFile(mask, R"({"id": 5, "file_name": "1.png"})")), HasSubstr("width"));
  for (const char* width : {"0", "-4", "8193", "1e300", "\"4\"", "null"}) {
    const std::string image =
        R"({"id": 5, "file_name": "1.png", "height": 3, "width": )" + std::string(width) + "}";
    EXPECT_THAT(failureOf(cocoFile(mask, image)), HasSubstr("m.json")) << width;
  }
  const std::string large = R"({"id": 5, "file_name": "1.png", "height": 8192, "width": 8192})";
  EXPECT_THAT(failureOf(cocoFile(mask, large)), HasSubstr("8192x8192"));
}

TEST(CocoMasks, RefusesAnnotations_WhenTheirImageIsNotListed) {
  const std::string image = R"({"id": 6, "file_name": "1.png", "width": 4, "height": 3})";
  EXPECT_THAT(failureOf(cocoFile(R"({"size": [3, 4], "counts": [12]})", image)), HasSubstr("image 5"));
  const std::string twice = image + ", " + image;
  EXPECT_THAT(failureOf(cocoFile("[]", twice)), HasSubstr("another image"));
}

TEST(CocoMasks, RefusesOtherFiles) {
  for (const char* text : {"", "{", "[]", "7", R"({"images": []})", R"({"annotations": []})",
                           R"({"images": [1], "annotations": []})", R"({"images": {}, "annotations": 3})"})
    EXPECT_THAT(failureOf(text), HasSubstr("m.json")) << text;
  const std::string whole = cocoFile(R"({"size": [3, 4], "counts": [2, 3, 7]})");
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(CocoMasks::parse(whole.substr(0, length), "m.json")) << length;
}

}  // namespace
}  // namespace scantrove
