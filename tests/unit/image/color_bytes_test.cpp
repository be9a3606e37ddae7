// Orientations in JPEG and PNG files, and files that every program decodes alike.
#include "core/image/color_bytes.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/image/image_file.h"
#include "tests/support/oriented_image.h"

namespace scantrove {
namespace {

using test::decodeUpright;
using test::encoded;
using test::exifDirectory;
using test::withExif;
using test::withSegment;

std::span<const std::uint8_t> viewOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

cv::Mat someImage(int type = CV_8UC3) {
  cv::Mat image(24, 32, type);
  cv::randu(image, 0, image.depth() == CV_8U ? 255 : 65000);
  return image;
}

/// Inserts a chunk with its CRC-32 after the header of a PNG.
std::string withChunk(const std::string& png, const std::string& type, const std::string& content) {
  const std::string typed = type + content;
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : typed) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? sum >> 1U ^ 0xEDB88320U : sum >> 1U;
  }
  sum = ~sum;
  std::string chunk;
  for (const std::uint32_t number : {static_cast<std::uint32_t>(content.size()), sum}) {
    for (int shift = 24; shift >= 0; shift -= 8)
      chunk += static_cast<char>(number >> static_cast<unsigned>(shift));
    if (chunk.size() == 4) chunk += typed;
  }
  constexpr std::size_t kHeaderEnd = 33;
  return png.substr(0, kHeaderEnd) + chunk + png.substr(kHeaderEnd);
}

TEST(WithoutOrientation, ClearsExif_AnywhereInAJpeg) {
  const std::string jpeg = encoded(".jpg", someImage());
  for (const bool is_big_endian : {false, true}) {
    for (int orientation = 2; orientation <= 8; ++orientation) {
      const std::string turned = withExif(jpeg, is_big_endian, orientation);
      EXPECT_TRUE(withoutOrientation(turned) == withExif(jpeg, is_big_endian, 1)) << orientation;
      const std::string behind_others = withSegment(withSegment(turned, '\xFE', "a comment"), '\xE0', "JFIF");
      EXPECT_TRUE(
          cv::norm(decodeUpright(withoutOrientation(behind_others)), decodeUpright(jpeg), cv::NORM_INF) == 0);
    }
    const std::string upright = withExif(jpeg, is_big_endian, 1);
    EXPECT_TRUE(withoutOrientation(upright) == upright);
  }
  EXPECT_TRUE(withoutOrientation(jpeg) == jpeg);
}

TEST(WithoutOrientation, ClearsXmp_InAJpeg) {
  const std::string jpeg = encoded(".jpg", someImage());
  const std::string name("http://ns.adobe.com/xap/1.0/\0", 29);
  for (const auto& [written, cleared] :
       {std::pair<std::string, std::string>{"<x tiff:Orientation=\"6\"/>", "<x tiff:Orientation=\"1\"/>"},
        {"<x tiff:Orientation = '3'/>", "<x tiff:Orientation = '1'/>"},
        {"<tiff:Orientation>8</tiff:Orientation>", "<tiff:Orientation>1</tiff:Orientation>"}}) {
    EXPECT_TRUE(withoutOrientation(withSegment(jpeg, '\xE1', name + written)) ==
                withSegment(jpeg, '\xE1', name + cleared))
        << written;
  }
}

TEST(WithoutOrientation, ClearsOrRemovesMetadata_InAPng) {
  const cv::Mat image = someImage();
  const std::string png = encoded(".png", image);
  for (const bool is_big_endian : {false, true}) {
    const std::string turned = withChunk(png, "eXIf", exifDirectory(is_big_endian, 6));
    EXPECT_TRUE(withoutOrientation(turned) == withChunk(png, "eXIf", exifDirectory(is_big_endian, 1)));
  }
  const std::string xmp("XML:com.adobe.xmp\0\0\0\0\0", 22);
  EXPECT_TRUE(withoutOrientation(withChunk(png, "iTXt", xmp + "tiff:Orientation=\"6\"")) ==
              withChunk(png, "iTXt", xmp + "tiff:Orientation=\"1\""));
  EXPECT_TRUE(
      withoutOrientation(withChunk(png, "zTXt", std::string("Raw profile type exif\0\0packed", 29))) == png);
  const std::string with_author = withChunk(png, "tEXt", std::string("Author\0me", 9));
  EXPECT_TRUE(withoutOrientation(with_author) == with_author);
  const auto read = decodeColorImage(viewOf(withoutOrientation(with_author)), "x");
  ASSERT_TRUE(read);
  EXPECT_EQ(cv::norm(*read, image, cv::NORM_INF), 0);
}

TEST(WithoutOrientation, ReadsWithinBounds_WhenFilesAreDamaged) {
  const std::string jpeg = withExif(encoded(".jpg", someImage()), true, 6);
  const std::string png = withChunk(encoded(".png", someImage()), "eXIf", exifDirectory(false, 6));
  for (const std::string& intact : {jpeg, png}) {
    for (std::size_t length = 0; length < std::min<std::size_t>(intact.size(), 400); ++length)
      EXPECT_EQ(withoutOrientation(intact.substr(0, length)).size(), length);
    for (std::size_t at = 2; at < 120; ++at) {
      std::string changed = intact;
      changed[at] = '\xFF';
      EXPECT_LE(withoutOrientation(changed).size(), changed.size());
    }
  }
}

TEST(IsPlainColor, AcceptsOnlyThreeChannelsOfEightBits) {
  EXPECT_TRUE(isPlainColor(viewOf(encoded(".jpg", someImage()))));
  EXPECT_TRUE(isPlainColor(viewOf(encoded(".png", someImage()))));
  for (const int type : {CV_8UC1, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4})
    EXPECT_FALSE(isPlainColor(viewOf(encoded(".png", someImage(type))))) << type;
  EXPECT_FALSE(isPlainColor(viewOf(encoded(".jpg", someImage(CV_8UC1)))));
  EXPECT_FALSE(isPlainColor(viewOf(encoded(".bmp", someImage()))));
  EXPECT_FALSE(isPlainColor(viewOf(withChunk(encoded(".png", someImage()), "tRNS", std::string(6, '\0')))));
  EXPECT_FALSE(isPlainColor({}));
}

}  // namespace
}  // namespace scantrove
