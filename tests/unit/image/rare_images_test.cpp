// Valid images that few programs write.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include "core/image/image_file.h"

namespace scantrove {
namespace {

std::span<const std::uint8_t> asBytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A CMYK JPEG with equal pixels.
std::string cmykJpeg(std::array<std::uint8_t, 4> inks, J_COLOR_SPACE stored_as, bool by_adobe) {
  jpeg_error_mgr errors{};
  jpeg_compress_struct jpeg{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = 24, jpeg.image_height = 16;
  jpeg.input_components = 4;
  jpeg.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_colorspace(&jpeg, stored_as);
  jpeg.write_Adobe_marker = by_adobe ? TRUE : FALSE;
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row;
  for (int x = 0; x < 24; ++x) row.insert(row.end(), inks.begin(), inks.end());
  for (int y = 0; y < 16; ++y) {
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return text;
}

void expectColor(const std::string& jpeg, const cv::Vec3b& expected_bgr) {
  const auto image = decodeColorImage(asBytes(jpeg), "inks.jpg");
  ASSERT_TRUE(image) << image.error().message();
  ASSERT_EQ(image->size(), cv::Size(24, 16));
  ASSERT_EQ(image->type(), CV_8UC3);
  for (const cv::Point& at : {cv::Point(0, 0), cv::Point(23, 15)})
    EXPECT_LE(cv::norm(image->at<cv::Vec3b>(at), expected_bgr, cv::NORM_INF), 3) << image->at<cv::Vec3b>(at);
}

TEST(ImageDecoders, ConvertCmykJpegs) {
  // Adobe inverts inks: a stored cyan of 200 without black means red 200.
  for (const J_COLOR_SPACE stored_as : {JCS_CMYK, JCS_YCCK})
    expectColor(cmykJpeg({200, 40, 30, 255}, stored_as, true), {30, 40, 200});
  expectColor(cmykJpeg({200, 40, 30, 128}, JCS_CMYK, true), {15, 20, 100});
  expectColor(cmykJpeg({55, 215, 225, 0}, JCS_CMYK, false), {30, 40, 200});
}

TEST(ImageDecoders, ReadTextPnm_WithoutFinalNewline) {
  const std::string depth = "P2\n# made by hand\n3 2\n65535\n100 200 300\n400 500 600";
  for (const std::string& text : {depth, depth + "\n"}) {
    const auto image = decodeDepthImage(asBytes(text), "depth.pgm");
    ASSERT_TRUE(image) << image.error().message();
    ASSERT_EQ(image->size(), cv::Size(3, 2));
    EXPECT_EQ(image->at<std::uint16_t>(0, 0), 100);
    EXPECT_EQ(image->at<std::uint16_t>(1, 2), 600);
  }
  const auto color = decodeColorImage(asBytes("P3 2 1 255 1 2 3 4 5 66"), "color.ppm");
  ASSERT_TRUE(color) << color.error().message();
  EXPECT_EQ(color->at<cv::Vec3b>(0, 1), cv::Vec3b(66, 5, 4));
  const auto bits = decodeGrayImage(asBytes("P1 2 2 0 1 1 0"), "mask.pbm");
  ASSERT_TRUE(bits) << bits.error().message();
  EXPECT_FALSE(decodeDepthImage(asBytes("P2 3 2 65535 100 200 300 400 500"), "short.pgm"))
      << "a pixel is missing";
}

}  // namespace
}  // namespace scantrove
