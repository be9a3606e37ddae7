#include <gtest/gtest.h>

#include "core/dataset/silhouette.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(VocExportTest, DatasetFormat::voc);

/// The contents of all elements `tag`, with character references resolved.
std::vector<std::string> contentsOf(const std::string& xml, const std::string& tag) {
  std::vector<std::string> contents;
  for (std::size_t at = 0; (at = xml.find("<" + tag + ">", at)) != std::string::npos;) {
    at += tag.size() + 2;
    const std::string raw = xml.substr(at, xml.find("</" + tag + ">", at) - at);
    std::string text;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] == '&' && raw[i + 1] == '#') {
        text += static_cast<char>(std::stoi(raw.substr(i + 2)));
        i = raw.find(';', i);
      } else {
        text += raw[i];
      }
    }
    contents.push_back(text);
  }
  return contents;
}

/// Pixels of one colour of a palette image, which OpenCV expands (BGR).
cv::Mat pixelsOf(const cv::Mat& image, const cv::Scalar& bgr) {
  cv::Mat mask;
  cv::inRange(image, bgr, bgr, mask);
  return mask;
}

// VOC's first colours: 1 = dark red, 2 = dark green.
const cv::Scalar kFirst(0, 0, 128), kSecond(0, 128, 0);

TEST_F(VocExportTest, HasTheFiles) {
  std::vector<std::string> expected;
  for (const std::string folder : {"Annotations/", "ImageSets/Main/", "ImageSets/Segmentation/",
                                   "JPEGImages/", "SegmentationClass/", "SegmentationObject/"}) {
    const bool is_list = folder.starts_with("ImageSets");
    const std::string end = folder == "Annotations/" ? ".xml" : folder == "JPEGImages/" ? ".jpg" : ".png";
    for (const std::string frame : {"000000", "000010", "000020"}) {
      if (!is_list) expected.push_back(folder + frame + end);
    }
    if (!is_list) continue;
    for (const char* list : {"train.txt", "trainval.txt", "val.txt"}) expected.push_back(folder + list);
  }
  expected.emplace_back("labelmap.txt");
  expected.emplace_back("labels.json");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(exported().files(), expected);
  EXPECT_EQ(exported().text("JPEGImages/000010.jpg"), readText(exported().scene.fileOf(10)));
  EXPECT_EQ(exported().text("ImageSets/Main/trainval.txt"), "000000\n000010\n000020\n");
  EXPECT_EQ(exported().text("labelmap.txt"),
            "# label:color_rgb:parts:actions\nbackground:0,0,0::\nball:128,0,0::\nbox:0,128,0::\n");
}

TEST_F(VocExportTest, MasksArePaletteImages) {
  for (const char* folder : {"SegmentationClass/", "SegmentationObject/"}) {
    const std::string png = exported().text(folder + std::string("000010.png"));
    EXPECT_EQ(static_cast<int>(png[24]), 8) << "bits";
    EXPECT_EQ(static_cast<int>(png[25]), 3) << "colour type: palette";
    const std::size_t palette = png.find("PLTE");
    ASSERT_NE(palette, std::string::npos);
    EXPECT_EQ(png.substr(palette + 4 + 3 * 255, 3), "\xE0\xE0\xC0") << "VOC's colour of the border";
  }
  const cv::Mat classes = exported().image("SegmentationClass/000010.png");
  const cv::Mat objects = exported().image("SegmentationObject/000010.png");
  EXPECT_EQ(classes.size(), cv::Size(640, 480));
  const cv::Mat ball = exported().scene.exactMask(10, kBall), box = exported().scene.exactMask(10, kBox);
  EXPECT_GE(iou(pixelsOf(classes, kFirst), ball), 0.95);
  EXPECT_GE(iou(pixelsOf(classes, kSecond), box), 0.95);
  EXPECT_GE(iou(pixelsOf(objects, kFirst), box), 0.95) << "objects are numbered as in the annotation";
  EXPECT_GE(iou(pixelsOf(objects, kSecond), ball), 0.95);
}

TEST_F(VocExportTest, AnnotationsDescribeTheMasks) {
  const std::string xml = exported().text("Annotations/000010.xml");
  EXPECT_EQ(contentsOf(xml, "filename"), std::vector<std::string>{"000010.jpg"});
  EXPECT_EQ(contentsOf(xml, "width"), std::vector<std::string>{"640"});
  EXPECT_EQ(contentsOf(xml, "height"), std::vector<std::string>{"480"});
  EXPECT_EQ(contentsOf(xml, "depth"), std::vector<std::string>{"3"});
  EXPECT_EQ(contentsOf(xml, "truncated"), (std::vector<std::string>{"0", "0"}));
  EXPECT_EQ(contentsOf(xml, "value"), (std::vector<std::string>{kBoxName, "12", "ball", "40"}));
  const cv::Mat objects = exported().image("SegmentationObject/000010.png");
  const cv::Rect boxes[] = {boxOf(pixelsOf(objects, kFirst)), boxOf(pixelsOf(objects, kSecond))};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(contentsOf(xml, "xmin").at(i), std::to_string(boxes[i].x + 1)) << "pixels count from 1";
    EXPECT_EQ(contentsOf(xml, "ymin").at(i), std::to_string(boxes[i].y + 1));
    EXPECT_EQ(contentsOf(xml, "xmax").at(i), std::to_string(boxes[i].br().x)) << "the last pixel is inside";
    EXPECT_EQ(contentsOf(xml, "ymax").at(i), std::to_string(boxes[i].br().y));
  }
}

TEST(VocExport, EscapesNames) {
  const std::string name = "a<b> & \"c\" 'd'\nnext: #1";
  const Exported exported(DatasetFormat::voc, [&](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].name = name;
    scene.scan_name = "<scan> & co";
  });
  const std::string xml = exported.text("Annotations/000000.xml");
  const auto names = contentsOf(xml, "name");
  EXPECT_EQ(std::count(names.begin(), names.end(), name), 1);
  EXPECT_EQ(contentsOf(xml, "database"), std::vector<std::string>{"Scantrove: <scan> & co"});
  EXPECT_EQ(xml.find("a<b"), std::string::npos);
  EXPECT_NE(exported.text("labelmap.txt").find("a<b> & \"c\" 'd' next_ _1:128,0,0::\n"), std::string::npos);
}

TEST(VocExport, ConvertsImages_WhenRecordedAsPng) {
  const Exported exported(DatasetFormat::voc, [](ScannedScene& scene) {
    scene.frames = 1;
    const auto file = (*scene.keyFrames(true)).front().color_file;
    const cv::Mat image = cv::imread(file.string());
    std::vector<std::uint8_t> png;
    cv::imencode(".png", image, png);
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(png.data()), std::ssize(png));
  });
  EXPECT_EQ(exported.text("JPEGImages/000000.jpg").substr(0, 3), "\xFF\xD8\xFF");
  const cv::Mat written = exported.image("JPEGImages/000000.jpg");
  ASSERT_EQ(written.size(), cv::Size(640, 480));
  EXPECT_LT(cv::norm(written, cv::imread(exported.scene.fileOf(0).string()), cv::NORM_L1) / (640 * 480 * 3),
            4);
}

TEST(VocExport, UsesTheLastFifthForValidation) {
  const Exported many(DatasetFormat::voc, [](ScannedScene& scene) { scene.frames = 9; });
  EXPECT_EQ(many.text("ImageSets/Main/val.txt"), "000080\n");
  EXPECT_EQ(many.text("ImageSets/Segmentation/train.txt"), "000000\n000020\n000040\n000060\n");
}

TEST(VocExport, Fails_WithMoreClassesThanColors) {
  ScannedScene scene;
  scene.frames = 1;
  for (std::uint32_t id = 100; id < 400; ++id) {
    LabeledRegion region;
    region.id = id;
    region.name = "thing " + std::to_string(id);
    scene.labels.push_back(region);
  }
  const TemporaryFolder home;
  const auto result = exportDataset(scene, {.format = DatasetFormat::voc, .folder = home / "out"});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message().find("302 classes"), std::string::npos) << result.error().message();
}

}  // namespace
}  // namespace scantrove::test
