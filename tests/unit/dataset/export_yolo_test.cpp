#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(YoloExportTest, DatasetFormat::yolo);

struct Segment {
  int class_index = -1;
  std::vector<double> numbers;

  /// Filled as programs do that round coordinates or truncate them.
  [[nodiscard]] cv::Mat mask(bool rounds) const {
    std::vector<cv::Point> outline;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      const double x = numbers[i] * 640, y = numbers[i + 1] * 480;
      outline.emplace_back(static_cast<int>(rounds ? std::round(x) : x),
                           static_cast<int>(rounds ? std::round(y) : y));
    }
    cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
    cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{outline}, 255);
    return mask;
  }
};

std::vector<Segment> segmentsIn(const std::string& text) {
  std::vector<Segment> segments;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    Segment& segment = segments.emplace_back();
    words >> segment.class_index;
    for (double number = 0; words >> number;) segment.numbers.push_back(number);
  }
  return segments;
}

TEST_F(YoloExportTest, HasTheFiles) {
  EXPECT_EQ(exported().files(),
            (std::vector<std::string>{"data.yaml", "images/train/000000.jpg", "images/train/000010.jpg",
                                      "images/train/000020.jpg", "labels.json", "labels/train/000000.txt",
                                      "labels/train/000010.txt", "labels/train/000020.txt"}));
  EXPECT_EQ(
      exported().text("data.yaml"),
      "# Scantrove: kitchen table\ntrain: images/train\nval: images/train  # too few images for others\n"
      "names:\n  0: \"ball\"\n  1: \"box\"\n");
  EXPECT_EQ(exported().text("images/train/000010.jpg"), readText(exported().scene.fileOf(10)));
}

TEST_F(YoloExportTest, PolygonsReproduceTheMasks) {
  for (const int frame : {0, 10, 20}) {
    const auto segments = segmentsIn(exported().text(
        "labels/train/0000" + std::string(frame == 0 ? "00" : std::to_string(frame)) + ".txt"));
    ASSERT_EQ(segments.size(), 2U);
    for (const Segment& segment : segments) {
      EXPECT_GE(segment.numbers.size(), 6U);
      EXPECT_EQ(segment.numbers.size() % 2, 0U);
      for (const double number : segment.numbers) EXPECT_TRUE(number >= 0 && number <= 1);
      const cv::Mat exact = exported().scene.exactMask(frame, segment.class_index == 0 ? kBall : kBox);
      for (const bool rounds : {false, true}) EXPECT_GE(iou(segment.mask(rounds), exact), 0.95) << frame;
      EXPECT_EQ(cv::countNonZero(segment.mask(false) != segment.mask(true)), 0);
    }
  }
}

TEST(YoloExport, HasOneLine_WhenAnInstanceHasTwoRegions) {
  const Exported exported(DatasetFormat::yolo, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].object = 3;  // the ball belongs to the object of the box
    scene.labels[0].category = "box";
  });
  const auto segments = segmentsIn(exported.text("labels/train/000000.txt"));
  ASSERT_EQ(segments.size(), 1U);
  const cv::Mat exact = exported.scene.exactMask(0, kBox) | exported.scene.exactMask(0, kBall);
  EXPECT_GE(iou(segments[0].mask(false), exact), 0.95);
  EXPECT_EQ(exported.summary.annotations, 1);
}

TEST(YoloExport, HasALineForEachRegion_WhenOnlyNamesAreEqual) {
  const Exported exported(DatasetFormat::yolo, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].name = scene.labels[2].name = "box";
    scene.labels[0].category = "box";
    scene.labels[2].object.reset();
  });
  EXPECT_EQ(segmentsIn(exported.text("labels/train/000000.txt")).size(), 2U);
}

TEST(YoloExport, HasOneLine_WhenARegionHasTwoPieces) {
  const Exported exported(DatasetFormat::yolo, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.divided = kBox;
  });
  const auto segments = segmentsIn(exported.text("labels/train/000000.txt"));
  ASSERT_EQ(segments.size(), 2U);
  const auto box = std::find_if(segments.begin(), segments.end(),
                                [](const Segment& segment) { return segment.class_index == 1; });
  ASSERT_NE(box, segments.end());
  cv::Mat labels;
  EXPECT_EQ(cv::connectedComponents(box->mask(false), labels, 8), 2) << "background and one piece";
  const cv::Mat pieces = exported.scene.dividedMask(exported.scene.exactMask(0, kBox));
  EXPECT_EQ(cv::connectedComponents(pieces, labels, 8), 3);
  EXPECT_GE(iou(box->mask(false), pieces), 0.9) << "the gap is that of another view than the exact mask's";
}

TEST(YoloExport, UsesTheLastFifthForValidation) {
  const Exported many(DatasetFormat::yolo, [](ScannedScene& scene) {
    scene.frames = 9;  // every second is a key frame: five
    scene.labels[0].name = "ball: \"red\" # 1\n";
  });
  const auto files = many.files();
  EXPECT_EQ(
      std::count_if(files.begin(), files.end(), [](const auto& f) { return f.starts_with("labels/train/"); }),
      4);
  EXPECT_TRUE(std::filesystem::exists(many.file("labels/val/000080.txt")));
  EXPECT_TRUE(std::filesystem::exists(many.file("images/val/000080.jpg")));
  const std::string yaml = many.text("data.yaml");
  EXPECT_NE(yaml.find("val: images/val\n"), std::string::npos);
  EXPECT_NE(yaml.find("  0: \"ball: \\\"red\\\" # 1\\u000A\"\n"), std::string::npos) << yaml;
}

}  // namespace
}  // namespace scantrove::test
