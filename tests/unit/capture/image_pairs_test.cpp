#include "core/capture/image_pairs.h"

#include <gmock/gmock.h>

#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Writes NAME-depth.png with this depth, and NAME-color with this ending and blue.
void writePair(const test::TemporaryFolder& folder, const std::string& name, int depth, int blue,
               const std::string& color_ending = ".png") {
  test::writeImage(folder / (name + "-depth.png"), test::tinyDepth(depth));
  test::writeImage(folder / (name + "-color" + color_ending), test::tinyColor(blue));
}

TEST(OpenImagePairs, FindsPairsByName) {
  const test::TemporaryFolder folder;
  writePair(folder, "mug", 1300, 130);
  writePair(folder, "bowl", 1100, 110);
  writePair(folder, "fork-2", 1200, 120);
  const auto pairs = openImagePairs(folder.path());
  ASSERT_TRUE(pairs) << pairs.error().message();
  EXPECT_THAT(pairs->names, ElementsAre("bowl", "fork-2", "mug"));
  EXPECT_EQ(pairs->frames->info().frame_count, 3);
  EXPECT_FALSE(pairs->frames->info().has_poses);
  const auto reads = test::readAll(*pairs->frames);
  ASSERT_EQ(reads.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const FrameRead& read = reads[static_cast<std::size_t>(i)];
    ASSERT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
    EXPECT_EQ(read.frame.index, i) << "the index of its name";
    EXPECT_EQ(read.frame.depth.at<std::uint16_t>(10, 10), 1100 + 100 * i);
    EXPECT_EQ(read.frame.color.at<cv::Vec3b>(10, 10)[0], 110 + 10 * i);
    EXPECT_FLOAT_EQ(read.frame.meters_per_unit, 0.001F);
  }
}

TEST(OpenImagePairs, ReadsColorOfEachFormat) {
  const test::TemporaryFolder folder;
  writePair(folder, "a", 1000, 100, ".jpg");
  writePair(folder, "b", 1000, 100, ".jpeg");
  writePair(folder, "c", 1000, 100, ".png");
  const auto pairs = openImagePairs(folder.path());
  ASSERT_TRUE(pairs) << pairs.error().message();
  EXPECT_THAT(pairs->names, ElementsAre("a", "b", "c"));
  for (const FrameRead& read : test::readAll(*pairs->frames)) {
    ASSERT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
    EXPECT_NEAR(read.frame.color.at<cv::Vec3b>(10, 10)[0], 100, 8);
  }
}

TEST(OpenImagePairs, TakesTheCameraFromItsFile) {
  const test::TemporaryFolder folder;
  writePair(folder, "mug", 1300, 130);
  folder.write("cam_K.txt", "50 0 31\n0 51 23\n0 0 1\n");
  const auto pairs = openImagePairs(folder.path());
  ASSERT_TRUE(pairs) << pairs.error().message();
  EXPECT_EQ(pairs->frames->info().intrinsics,
            (Intrinsics{50, 51, 31, 23, test::kTinyWidth, test::kTinyHeight}));
}

TEST(OpenImagePairs, CameraIsThatOfTheOptions_OrADefaultWithoutAFile) {
  const test::TemporaryFolder folder;
  writePair(folder, "mug", 1300, 130);
  const auto pairs = openImagePairs(folder.path());
  ASSERT_TRUE(pairs) << pairs.error().message();
  EXPECT_EQ(pairs->frames->info().intrinsics,
            (Intrinsics{525, 525, 319.5F, 239.5F, 640, 480}.resizedTo(test::kTinyWidth, test::kTinyHeight)));
  folder.write("cam_K.txt", "50 0 31\n0 51 23\n0 0 1\n");
  SourceOptions options;
  options.intrinsics = Intrinsics{60, 61, 30, 22, 0, 0};
  const auto other = openImagePairs(folder.path(), options);
  ASSERT_TRUE(other) << other.error().message();
  EXPECT_EQ(other->frames->info().intrinsics,
            (Intrinsics{60, 61, 30, 22, test::kTinyWidth, test::kTinyHeight}));
}

TEST(OpenImagePairs, LeavesOutImagesWithoutTheirOther) {
  const test::TemporaryFolder folder;
  writePair(folder, "mug", 1300, 130);
  test::writeImage(folder / "bowl-depth.png", test::tinyDepth(1000));
  test::writeImage(folder / "fork-color.png", test::tinyColor(100));
  test::writeImage(folder / "depth.png", test::tinyDepth(1000));
  const auto pairs = openImagePairs(folder.path());
  ASSERT_TRUE(pairs) << pairs.error().message();
  EXPECT_THAT(pairs->names, ElementsAre("mug"));
  const auto reads = test::readAll(*pairs->frames);
  ASSERT_EQ(reads.size(), 1U);
  EXPECT_EQ(reads[0].frame.index, 0);
  EXPECT_EQ(reads[0].frame.depth.at<std::uint16_t>(10, 10), 1300);
}

TEST(OpenImagePairs, ErrorNamesTheFolder_WithoutPairs) {
  const test::TemporaryFolder folder;
  test::writeImage(folder / "bowl-depth.png", test::tinyDepth(1000));
  const auto none = openImagePairs(folder.path());
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message(), HasSubstr(folder.path().string()));
  EXPECT_THAT(none.error().message(), HasSubstr("-depth.png"));
  const auto missing = openImagePairs(folder / "missing");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr((folder / "missing").string()));
}

TEST(OpenImagePairs, ErrorNamesTheFile_WhenTheCameraCannotBeRead) {
  const test::TemporaryFolder folder;
  writePair(folder, "mug", 1300, 130);
  folder.write("cam_K.txt", "no numbers\n");
  const auto pairs = openImagePairs(folder.path());
  ASSERT_FALSE(pairs);
  EXPECT_THAT(pairs.error().message(), HasSubstr("cam_K.txt"));
}

}  // namespace
}  // namespace scantrove
