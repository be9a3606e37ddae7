#include "core/capture/video_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/deflated_frames.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_video.h"
#include "tests/support/zip_bytes.h"
#include "tests/unit/capture/phone_files.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

/// A middle pixel, B, G, R.
cv::Vec3b middle(const cv::Mat& image) { return image.at<cv::Vec3b>(image.rows / 2, image.cols / 2); }

void expectGrey(const Result<cv::Mat>& image, int number) {
  ASSERT_TRUE(image) << image.error().message();
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(middle(*image)[channel], greyOfTinyVideo(number), 3) << number;
}

TEST(VideoFrames, ReturnsPicturesByPosition) {
  const TemporaryFolder folder;
  for (const char* const name : {"a.mp4", "a.mkv"}) {
    writeTinyVideo(folder / name, 10, 70, 50);  // 70: not a multiple of the scaler's vectors
    VideoFrames video(folder / name);
    for (const int position : {0, 1, 2, 5, 5, 9, 3, 4}) {
      const auto image = video.frame(position);
      expectGrey(image, position);
      EXPECT_EQ(image->size(), cv::Size(70, 50));
      EXPECT_TRUE(image->isContinuous());
    }
  }
}

TEST(VideoFrames, Fails_BeyondTheEnd) {
  const TemporaryFolder folder;
  writeTinyVideo(folder / "a.mp4", 3, 64, 48);
  VideoFrames video(folder / "a.mp4");
  const auto beyond = video.frame(3);
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().what, HasSubstr("a.mp4"));
  expectGrey(video.frame(2), 2);
}

TEST(VideoFrames, Fails_WhenFileIsNoVideo) {
  const TemporaryFolder folder;
  folder.write("text.mp4", "no video");
  // A playlist could name files anywhere; it is no container of a camera.
  folder.write("list.mp4", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\na.mp4\n#EXT-X-ENDLIST\n");
  writeTinyVideo(folder / "a.mp4", 3, 64, 48);
  std::filesystem::resize_file(folder / "a.mp4", 200);
  for (const char* const name : {"text.mp4", "list.mp4", "a.mp4", "missing.mp4"}) {
    const auto image = VideoFrames(folder / name).frame(0);
    ASSERT_FALSE(image) << name;
    EXPECT_THAT(image.error().what, HasSubstr(name));
  }
}

TEST(DeflatedFrames, ReturnsFramesByPosition) {
  const TemporaryFolder folder;
  constexpr std::size_t kFrameBytes = 100'000;
  std::string all;
  for (const char letter : {'a', 'b', 'c', 'd'}) all += std::string(kFrameBytes, letter);
  const auto file = folder.write("x.depth.zlib", rawDeflated(all));
  DeflatedFrames frames(file, kFrameBytes);
  for (const int position : {0, 0, 1, 3, 2}) {
    const auto frame = frames.frame(position);
    ASSERT_TRUE(frame) << frame.error().message();
    EXPECT_EQ(*frame, std::string(kFrameBytes, static_cast<char>('a' + position)));
  }
  EXPECT_FALSE(frames.frame(4));
}

TEST(DeflatedFrames, Fails_WhenFileIsDamagedOrTruncated) {
  const TemporaryFolder folder;
  const std::string packed = rawDeflated(zipBytes({{"some", "text that does not shrink to nothing"}}));
  EXPECT_FALSE(DeflatedFrames(folder.write("a", packed.substr(0, packed.size() / 2)), 100).frame(0));
  EXPECT_FALSE(DeflatedFrames(folder.write("b", "\x07\x07\x07\x07"), 100).frame(0));
  EXPECT_FALSE(DeflatedFrames(folder / "missing", 100).frame(0));
}

TEST(InflateBytes, WantsTheExactSize) {
  const std::string packed = rawDeflated("twelve bytes");
  EXPECT_EQ(inflateBytes(packed, 12, "x").value_or("?"), "twelve bytes");
  EXPECT_FALSE(inflateBytes(packed, 11, "x"));
  EXPECT_FALSE(inflateBytes(packed, 13, "x"));
  EXPECT_FALSE(inflateBytes("\xFF\xFF", 12, "x"));
}

}  // namespace
}  // namespace scantrove
