// Recordings with times in other units than seconds, or with names that are times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/captured_log.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int kFramesOfList = 6;

/// Lists of images at 30 Hz in units of `units_per_second`, colour 5 ms later; one pose a depth image.
void writeTimedLists(const TemporaryFolder& folder, double first_s, double units_per_second,
                     double units_of_poses) {
  std::string rgb = "# freiburg3\n", depth, truth;
  const auto stamp = [](double time_s, double units) {
    char text[64];
    std::snprintf(text, sizeof text, units > 1 ? "%.0f" : "%.6f", time_s * units);
    return std::string(text);
  };
  for (int i = 0; i < kFramesOfList; ++i) {
    const double time_s = first_s + i / 30.0;
    const std::string name = numbered("%d.png", i);
    depth += stamp(time_s, units_per_second) + " depth/" + name + "\n";
    rgb += stamp(time_s + 0.005, units_per_second) + " rgb/" + name + "\n";
    truth += stamp(time_s, units_of_poses) + numbered(" %d 0 0 0 0 0 1\n", i);
    writeImage(folder / "depth" / name, tinyDepth(5000 + i));
    writeImage(folder / "rgb" / name, tinyColor(i));
  }
  folder.write("rgb.txt", rgb);
  folder.write("depth.txt", depth);
  folder.write("groundtruth.txt", truth);
}

std::size_t timesFound(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

void expectFramesOfList(const TemporaryFolder& folder, double first_s) {
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), std::size_t{kFramesOfList});
  for (std::size_t i = 0; i < reads.size(); ++i) {
    const RgbdFrame& frame = reads[i].frame;
    EXPECT_NEAR(frame.timestamp_s, first_s + static_cast<double>(i) / 30, 6e-4) << i;
    EXPECT_EQ(frame.depth.at<std::uint16_t>(24, 32), 5000 + i);
    EXPECT_EQ(frame.color.at<cv::Vec3b>(24, 32)[0], i);
    ASSERT_TRUE(frame.T_world_camera) << i;
    EXPECT_NEAR(frame.T_world_camera->translation().x(), static_cast<double>(i), 0.05);
  }
}

TEST(TimeUnits, WarnsOnce_WhenImageSpacingShowsOtherUnits) {
  for (const auto& [units, word] :
       {std::pair{1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    for (const double first_s : {1305031229.0, 0.0, 1200.0}) {
      SCOPED_TRACE(std::string(word) + " from " + std::to_string(first_s));
      const TemporaryFolder folder;
      writeTimedLists(folder, first_s, units, units);
      const CapturedLog log;
      expectFramesOfList(folder, first_s);
      EXPECT_EQ(timesFound(log.text(), word), 1U) << log.text();
    }
  }
}

TEST(TimeUnits, WarnsOfNothing_WhenTimesAreSeconds) {
  for (const double first_s : {1305031229.0, 0.0}) {
    const TemporaryFolder folder;
    writeTimedLists(folder, first_s, 1, 1);
    const CapturedLog log;
    expectFramesOfList(folder, first_s);
    EXPECT_THAT(log.text(), Not(HasSubstr("seconds")));
  }
}

TEST(TimeUnits, PairsPosesWithImages_WhenTheirUnitsDiffer) {
  for (const double first_s : {1305031229.0, 0.0}) {
    const TemporaryFolder folder;
    writeTimedLists(folder, first_s, 1e9, 1);
    expectFramesOfList(folder, first_s);
    const TemporaryFolder other;
    writeTimedLists(other, first_s, 1, 1e9);
    expectFramesOfList(other, first_s);
  }
}

TEST(TimeUnits, KeepsSeconds_WhenImagesAreSecondsApart) {
  const TemporaryFolder folder;
  folder.write("depth.txt", "1305031229.5 depth/0.png\n1305031241.5 depth/1.png\n1305031252.5 depth/2.png\n");
  for (int i = 0; i < 3; ++i) writeImage(folder / "depth" / numbered("%d.png", i), tinyDepth(5000));
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_DOUBLE_EQ(readAll(**source)[2].frame.timestamp_s, 1305031252.5);
}

TEST(NumberedFolder, PairsEqualNames_WhenTheyAreTimes) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"1581120424100262102", "1581120424133595435",
                                          "1581120424166928768"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    writeImage(folder / "rgb" / (names[i] + ".jpg"), tinyColor(100));
    writeImage(folder / "depth" / (names[i] + ".png"), tinyDepth(1000 + static_cast<int>(i)));
  }
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].frame.index, static_cast<int>(i));
    EXPECT_EQ(reads[i].frame.depth.at<std::uint16_t>(5, 5), 1000 + i);
    EXPECT_NEAR(reads[i].frame.timestamp_s, 1581120424.100262102 + static_cast<double>(i) * 0.033333333,
                1e-6);
  }
  EXPECT_EQ(timesFound(log.text(), "nanoseconds"), 1U) << log.text();
}

TEST(NumberedFolder, OrdersByTime_WhenNamesAreSeconds) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"1305031229.966", "1305031229.999", "1305031230.033"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    writeImage(folder / "rgb" / (names[i] + ".png"), tinyColor(static_cast<int>(i)));
    writeImage(folder / "depth" / (names[i] + ".png"), tinyDepth(1000 + static_cast<int>(i)));
  }
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].frame.depth.at<std::uint16_t>(5, 5), 1000 + i);
    EXPECT_NEAR(reads[i].frame.timestamp_s, std::stod(names[i]), 1e-6);
  }
}

TEST(NumberedFolder, PairsEqualNames_WhenTheyAreText) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"left", "küche", "two words", "2024-05-01T12-30-15Z"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    writeImage(folder / "rgb" / (names[i] + ".jpg"), tinyColor(100));
    writeImage(folder / "depth" / (names[i] + ".png"), tinyDepth(1000 + static_cast<int>(i)));
  }
  writeImage(folder / "rgb" / "poster.jpg", tinyColor(1));
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 4U);
  const std::vector<int> in_order = {3, 1, 0, 2};
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].frame.index, static_cast<int>(i));
    EXPECT_DOUBLE_EQ(reads[i].frame.timestamp_s, static_cast<double>(i) / 30);
    EXPECT_EQ(reads[i].frame.depth.at<std::uint16_t>(5, 5), 1000 + in_order[i]) << i;
  }
  EXPECT_THAT(log.text(), HasSubstr("5 colour and 4 depth images"));
}

TEST(NumberedFolder, OrdersByNumberValue_WhenNamesAreEqual) {
  const TemporaryFolder folder;
  for (const int part : {1, 2}) {
    for (const int number : {2, 10}) {
      const std::string name = numbered("part%d", part) + numbered("_view%d_x1.png", number);
      writeImage(folder / "rgb" / name, tinyColor(7));
      writeImage(folder / "depth" / name, tinyDepth(100 * part + number));
    }
  }
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 4U);
  const std::vector<int> expected = {102, 110, 202, 210};
  for (std::size_t i = 0; i < reads.size(); ++i)
    EXPECT_EQ(reads[i].frame.depth.at<std::uint16_t>(5, 5), expected[i]) << i;
}

TEST(NumberedFolder, ReadsDepth_WhenThereIsNoColorFolder) {
  const TemporaryFolder folder;
  writeImage(folder / "depth" / "1581120424100262102.png", tinyDepth(1000));
  writeImage(folder / "depth" / "1581120424133595435.png", tinyDepth(1001));
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ(readAll(**source).size(), 2U);
}

TEST(NumberedFolder, ExplainsPairing_WhenNothingPairs) {
  const TemporaryFolder folder;
  writeImage(folder / "rgb" / "a.png", tinyColor(7));
  writeImage(folder / "depth" / "b.png", tinyDepth(1000));
  EXPECT_THAT(openError(folder.path()),
              testing::AllOf(HasSubstr("a.png"), HasSubstr("b.png"), HasSubstr("same name")));
}

TEST(Intrinsics, ReadsCamKFile_WhenInTheFolderOrItsParent) {
  for (const char* const name : {"recording/cam_K.txt", "cam_K.txt"}) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    writeNumberedFolder(folder / "recording", 0, 1);
    folder.write(name, "5.1e+01 0 3.1e+01\n0 5.2e+01 2.3e+01\n0 0 1\n");
    const CapturedLog log;
    const auto source = openSource((folder / "recording").string(), {});
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{51, 52, 31, 23, kTinyWidth, kTinyHeight}));
    EXPECT_THAT(log.text(), Not(HasSubstr("no intrinsics")));
  }
}

TEST(Intrinsics, ReadsDepthAndColor_WhenTheFolderIsScanNets) {
  const TemporaryFolder folder;
  writeImage(folder / "color/0.png", tinyColor(1, {128, 72}));
  writeImage(folder / "depth/0.png", tinyDepth(1000));
  folder.write("intrinsic/intrinsic_depth.txt", "51 0 31 0\n0 52 23 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("intrinsic/intrinsic_color.txt", "101 0 64 0\n0 102 36 0\n0 0 1 0\n0 0 0 1\n");
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{51, 52, 31, 23, kTinyWidth, kTinyHeight}));
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, FrameRead::Status::frame);
  ASSERT_TRUE(read.frame.color_camera);
  EXPECT_EQ(read.frame.color_camera->K, (Intrinsics{101, 102, 64, 36, 128, 72}));
  EXPECT_TRUE(read.frame.color_camera->T_color_depth.isApprox(Eigen::Isometry3d::Identity()));
}

TEST(Intrinsics, ReadsCamKFile_WhenTheFolderIsTums) {
  const TemporaryFolder folder;
  writeTimedLists(folder, 1305031229, 1, 1);
  folder.write("rgb.txt", "1305031229.005 rgb/0.png\n");
  folder.write("cam_K.txt", "51 0 31\n0 52 23\n0 0 1\n");
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{51, 52, 31, 23, kTinyWidth, kTinyHeight}));
  EXPECT_THAT(log.text(), IsEmpty());
}

TEST(Intrinsics, NamesTheFile_WhenItIsBroken) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 1);
  folder.write("cam_K.txt", "51 0 31\n0 52\n");
  EXPECT_THAT(openError(folder.path()), HasSubstr("cam_K.txt"));
  folder.write("cam_K.txt", "51 0 31\n0 52 23\n0 0 1\n");
  folder.write("intrinsic/intrinsic_depth.txt", "51 0 31\n0 52 23\n0 0 1\n9");
  EXPECT_THAT(openError(folder.path()), Not(HasSubstr("intrinsic_depth.txt"))) << "cam_K.txt comes first";
  std::filesystem::remove(folder / "cam_K.txt");
  EXPECT_THAT(openError(folder.path()), HasSubstr("intrinsic_depth.txt"));
}

TEST(ByteOrderMark, IsIgnored_WhenListsAndCameraFilesBeginWithIt) {
  const std::string mark = "\xEF\xBB\xBF";
  const TemporaryFolder folder;
  writeTimedLists(folder, 1305031229, 1, 1);
  for (const char* const name : {"rgb.txt", "depth.txt", "groundtruth.txt"})
    folder.write(name, mark + readText(folder / name));
  expectFramesOfList(folder, 1305031229);
  const TemporaryFolder numbers;
  writeNumberedFolder(numbers.path(), 0, 1);
  numbers.write("camera-intrinsics.txt", mark + "51 0 31\n0 52 23\n0 0 1\n");
  const auto source = openSource(numbers.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().intrinsics.fx, 51);
  std::filesystem::remove(numbers / "camera-intrinsics.txt");
  numbers.write("intrinsic.json", mark + R"({"intrinsic_matrix": [60, 0, 0, 0, 61, 0, 31, 23, 1]})");
  const auto by_json = openSource(numbers.path().string(), {});
  ASSERT_TRUE(by_json) << by_json.error().message();
  EXPECT_EQ((*by_json)->info().intrinsics.fx, 60);
}

}  // namespace
}  // namespace scantrove
