// Exported colour images are upright without an orientation tag, and 8-bit RGB.
#include <gtest/gtest.h>

#include <fstream>

#include "core/image/image_file.h"
#include "tests/support/oriented_image.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

constexpr std::array kImageFormats{DatasetFormat::coco, DatasetFormat::bop, DatasetFormat::yolo,
                                   DatasetFormat::masks, DatasetFormat::labelstudio};

/// One key frame whose colour image is `make(recorded bytes)`.
std::function<void(ScannedScene&)> withImage(const std::function<std::string(const std::string&)>& make) {
  return [make](ScannedScene& scene) {
    scene.frames = 1;
    const auto file = (*scene.keyFrames(true)).front().color_file;
    const std::string recorded = readText(file);
    std::ofstream(file, std::ios::binary) << make(recorded);
  };
}

/// The only colour image of an export.
std::string imageOf(const Exported& exported) {
  std::vector<std::string> found;
  for (const std::string& name : exported.files()) {
    const bool is_color =
        name.starts_with("images/") || name.starts_with("color/") || name.find("/rgb/") != name.npos;
    if (is_color) found.push_back(name);
  }
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? "" : found.front();
}

TEST(ExportedImages, LoseTheirOrientationTagWithoutRecompression) {
  for (const DatasetFormat format : kImageFormats) {
    for (const bool is_big_endian : {false, true}) {
      std::string recorded;
      const Exported exported(format, withImage([&](const std::string& jpeg) {
                                return recorded = withExif(jpeg, is_big_endian, 6);
                              }));
      ASSERT_EQ(decodeUpright(recorded).size(), cv::Size(480, 640))
          << "other programs rotate the recorded image";
      const std::string written = exported.text(imageOf(exported));
      EXPECT_EQ(decodeUpright(written).size(), cv::Size(640, 480));
      EXPECT_EQ(written.substr(0, 3), "\xFF\xD8\xFF") << "the image is not recompressed";
      const std::string scan_of_recorded = recorded.substr(recorded.find("\xFF\xDA"));
      EXPECT_TRUE(written.ends_with(scan_of_recorded));
    }
  }
}

TEST(ExportedImages, KeepTheirBytes_WhenUpright) {
  std::string recorded;
  const Exported exported(DatasetFormat::coco, withImage([&](const std::string& jpeg) {
                            return recorded = withExif(jpeg, true, 1);
                          }));
  EXPECT_TRUE(exported.text(imageOf(exported)) == recorded) << "not the same bytes";
}

TEST(ExportedImages, AreEightBitRgb_WhenRecordedWithOtherChannels) {
  const auto colorType = [](const std::string& png) {
    return std::pair(static_cast<int>(png[24]), static_cast<int>(png[25]));
  };
  for (const DatasetFormat format : kImageFormats) {
    for (const int type : {CV_8UC4, CV_16UC3, CV_16UC4, CV_8UC1, CV_16UC1}) {
      if (format != DatasetFormat::coco && type != CV_16UC4) continue;  // formats share the conversion
      SCOPED_TRACE(std::to_string(static_cast<int>(format)) + " type " + std::to_string(type));
      std::string recorded;
      const Exported exported(format, withImage([&](const std::string&) {
                                cv::Mat image(480, 640, type);
                                cv::randu(image, 0, image.depth() == CV_8U ? 255 : 65000);
                                return recorded = encoded(".png", image);
                              }));
      const std::string name = imageOf(exported);
      EXPECT_TRUE(name.ends_with(".png"));
      const std::string written = exported.text(name);
      EXPECT_EQ(colorType(written), std::pair(8, 2));
      const auto shown = decodeColorImage(
          {reinterpret_cast<const std::uint8_t*>(recorded.data()), recorded.size()}, "recorded");
      ASSERT_TRUE(shown);
      EXPECT_EQ(cv::norm(decodeUpright(written), *shown, cv::NORM_INF), 0);
    }
  }
}

TEST(ExportedImages, AreRgb_WhenRecordedAsGrayJpeg) {
  const Exported exported(DatasetFormat::bop, withImage([](const std::string&) {
                            return encoded(".jpg", cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
                          }));
  EXPECT_EQ(exported.image(imageOf(exported)).type(), CV_8UC3);
}

TEST(ExportedImages, KeepTheirBytes_WhenRecordedAsRgbPng) {
  std::string recorded;
  const Exported exported(DatasetFormat::yolo, withImage([&](const std::string&) {
                            cv::Mat image(480, 640, CV_8UC3);
                            cv::randu(image, 0, 255);
                            return recorded = encoded(".png", image);
                          }));
  EXPECT_TRUE(exported.text(imageOf(exported)) == recorded) << "not the same bytes";
}

}  // namespace
}  // namespace scantrove::test
