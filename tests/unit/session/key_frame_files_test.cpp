// Images of key frames as a session stores them.
#include "core/session/key_frame_files.h"

#include <gtest/gtest.h>

#include "core/session/session_store.h"
#include "tests/support/oriented_image.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::encoded;
using test::readText;
using test::TemporaryFolder;

RgbdFrame frameOf(const std::filesystem::path& color_file) {
  RgbdFrame frame;
  frame.meters_per_unit = 0.001F;
  frame.color = cv::Mat(24, 32, CV_8UC3, cv::Scalar(10, 90, 200));
  frame.depth = cv::Mat(24, 32, CV_16UC1, cv::Scalar(1000));
  frame.color_file = color_file;
  return frame;
}

std::string storedImage(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  const auto session = SessionStore::create(folder / "scan");
  EXPECT_TRUE(session) << session.error().message();
  const auto key = writeKeyFrame(**session, 3, frameOf(folder.write(name, bytes)));
  EXPECT_TRUE(key) << key.error().message();
  return key ? readText(folder / "scan" / key->color_file) : "";
}

TEST(WriteKeyFrame, ClearsTheOrientationOfAJpeg) {
  const TemporaryFolder folder;
  const std::string jpeg = encoded(".jpg", frameOf({}).color);
  const std::string turned = test::withExif(jpeg, true, 8);
  ASSERT_EQ(test::decodeUpright(turned).size(), cv::Size(24, 32));
  const std::string stored = storedImage(folder, "frame.jpg", turned);
  EXPECT_EQ(test::decodeUpright(stored).size(), cv::Size(32, 24));
  EXPECT_TRUE(stored.ends_with(jpeg.substr(jpeg.find("\xFF\xDA"))));
}

TEST(WriteKeyFrame, StoresAnUprightJpegUnchanged) {
  const TemporaryFolder folder;
  const std::string jpeg = test::withExif(encoded(".jpg", frameOf({}).color), false, 1);
  EXPECT_TRUE(storedImage(folder, "frame.jpg", jpeg) == jpeg) << "not the same bytes";
}

TEST(WriteKeyFrame, StoresNoReadings_OfLowConfidence) {
  const TemporaryFolder folder;
  const auto session = SessionStore::create(folder / "scan");
  ASSERT_TRUE(session) << session.error().message();
  RgbdFrame frame = frameOf({});
  frame.confidence = cv::Mat(24, 32, CV_8UC1, cv::Scalar(kMediumConfidence));
  frame.confidence.at<std::uint8_t>(3, 4) = kLowConfidence;
  const auto key = writeKeyFrame(**session, 3, frame);
  ASSERT_TRUE(key) << key.error().message();
  const auto read = readKeyFrame(folder / "scan", *key, SavedFrame{.number = 3});
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->depth.at<std::uint16_t>(3, 4), 0);
  EXPECT_EQ(cv::countNonZero(read->depth), 24 * 32 - 1);
}

TEST(WriteKeyFrame, EncodesByContent_WhenTheNameIsWrong) {
  const TemporaryFolder folder;
  const std::string bitmap = encoded(".bmp", frameOf({}).color);
  EXPECT_EQ(storedImage(folder, "frame.png", bitmap).substr(0, 4), "\x89PNG");
}

}  // namespace
}  // namespace scantrove
