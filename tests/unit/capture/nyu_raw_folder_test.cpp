// Raw scenes of NYUv2: names, times, swapped bytes, and the projection into the colour camera.
#include "core/capture/nyu_raw_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/capture/nyu_projection.h"
#include "core/capture/nyu_raw_names.h"
#include "tests/support/nyu_room.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using Status = FrameRead::Status;

TEST(NyuFileName, GivesKindAndTime) {
  const auto depth = nyuFileName("d-1294886360.208451-2996770081.pgm");
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->kind, NyuFileKind::depth);
  EXPECT_DOUBLE_EQ(depth->time_s, 1294886360.208451);
  EXPECT_EQ(nyuFileName("r-12941.6324869-2938947.ppm")->kind, NyuFileKind::color);
  EXPECT_EQ(nyuFileName("a-12941.6-1.dump")->kind, NyuFileKind::acceleration);
}

TEST(NyuFileName, IsEmpty_WhenTheFileIsAnother) {
  for (const char* name :
       {"", "d-", "d-.pgm", "d-1.5.pgm", "d-1.5-.pgm", "d--7.pgm", "d-1.5-7.ppm", "r-1.5-7.pgm",
        "x-1.5-7.pgm", "d-1.5.6-7.pgm", "d-1e5-7.pgm", "d-nan-7.pgm", "d-1.5-7x.pgm",
        "d-123456789012345678901.5-7.pgm", "INDEX.txt", "frame-000000.depth.png"}) {
    EXPECT_FALSE(nyuFileName(name)) << name;
  }
}

TEST(NyuRawPairs, TakeTheNearestColor_InOrderOfTime) {
  const std::vector<NyuRawPair> pairs =
      nyuRawPairs({"d-9.50-3.pgm", "d-10.00-1.pgm", "d-10.06-2.pgm", "r-10.02-1.ppm", "r-10.05-2.ppm",
                   "a-10.00-1.dump", "INDEX.txt", "r-9.61-1.ppm"});
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].depth, "d-9.50-3.pgm") << "by the value of the time, not by letters";
  EXPECT_EQ(pairs[0].color, "") << "0.11 s away";
  EXPECT_EQ(pairs[1].color, "r-10.02-1.ppm");
  EXPECT_EQ(pairs[2].color, "r-10.05-2.ppm");
  EXPECT_DOUBLE_EQ(pairs[2].time_s, 10.06);
}

TEST(NyuRawPairs, ShareAColorImage_WhenColorIsSlower) {
  const std::vector<NyuRawPair> pairs = nyuRawPairs({"d-1.00-1.pgm", "d-1.03-2.pgm", "r-1.01-1.ppm"});
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].color, pairs[1].color);
}

TEST(NyuDepth, FollowsTheFormulaOfTheToolbox) {
  EXPECT_NEAR(nyuDepth(917), 351.3 / (1092.5 - 917), 1e-6);
  EXPECT_NEAR(nyuDepth(1056), 9.6246, 1e-3);
  EXPECT_EQ(nyuDepth(1058), 0) << "10.18 m";
  EXPECT_EQ(nyuDepth(0), 0) << "0.32 m";
  EXPECT_EQ(nyuDepth(1093), 0) << "the formula gives a negative depth";
  EXPECT_EQ(nyuDepth(2047), 0) << "no reading";
  EXPECT_EQ(nyuDepth(65535), 0);
}

TEST(NyuSceneFolders, FindScenesInPartsAndBeside) {
  const TemporaryFolder folder;
  folder.write("raw/kitchen_0001/d-1.0-1.pgm", "");
  folder.write("raw/bathrooms_part1/bathroom_0002/d-1.0-1.pgm", "");
  const auto scenes = nyuSceneFolders(folder / "raw");
  ASSERT_TRUE(scenes) << scenes.error().message();
  EXPECT_EQ(scenes->at("kitchen_0001"), folder / "raw" / "kitchen_0001");
  EXPECT_EQ(scenes->at("bathroom_0002"), folder / "raw" / "bathrooms_part1" / "bathroom_0002");
  EXPECT_EQ(nyuSceneFolders(folder / "raw" / "kitchen_0001")->at("kitchen_0001"),
            folder / "raw" / "kitchen_0001");
  EXPECT_THAT(nyuSceneFolders(folder / "none").error().message(), HasSubstr("none"));
}

TEST(NyuRawFolder, IsRecognisedAndDescribed) {
  const TemporaryFolder folder;
  const NyuRoom room({320, 240});
  writeNyuScene(folder / "study_0001", room, 2);
  const auto source = openSource((folder / "study_0001").string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "NYUv2 raw");
  EXPECT_EQ(info.name, "study_0001");
  EXPECT_EQ(info.frame_count, 2);
  EXPECT_FALSE(info.has_poses);
  EXPECT_NEAR(info.intrinsics.fx, 518.8579 / 2, 1e-3);
  EXPECT_NEAR(info.intrinsics.cx, (325.58245 - 0.5) / 2 - 0.5, 1e-3) << "the toolbox counts pixels from 1";
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 2U);
  EXPECT_EQ(reads[1].frame.index, 1);
  EXPECT_NEAR(reads[1].frame.timestamp_s, 1294886360.241784, 1e-6);
  EXPECT_EQ(reads[1].frame.color.size(), room.size());
}

/// Pixels farther than 3 pixels from a change of the label.
cv::Mat1b insidePixels(const LabeledImage& labeled) {
  cv::Mat1w surfaces(labeled.labels.size());
  for (int i = 0; i < static_cast<int>(surfaces.total()); ++i)
    surfaces.ptr<std::uint16_t>()[i] = static_cast<std::uint16_t>(
        10 * labeled.labels.ptr<std::uint16_t>()[i] + labeled.instances.ptr<std::uint8_t>()[i]);
  cv::Mat lowest, highest;
  const cv::Mat kernel = cv::Mat::ones(7, 7, CV_8UC1);
  cv::erode(surfaces, lowest, kernel);
  cv::dilate(surfaces, highest, kernel);
  cv::Mat1b inside;
  cv::compare(lowest, highest, inside, cv::CMP_EQ);
  return inside;
}

TEST(NyuRawFolder, ShowsDepthAndColorFromTheUndistortedColorCamera) {
  const TemporaryFolder folder;
  const NyuRoom room({320, 240});
  writeNyuScene(folder.path(), room, 1);
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  const LabeledImage truth = room.labeled(0, "room", "d.pgm");
  const cv::Mat1b inside = insidePixels(truth);
  cv::Mat1f nearest, farthest;
  cv::erode(truth.depth_m, nearest, cv::Mat());
  cv::dilate(truth.depth_m, farthest, cv::Mat());
  int compared = 0, without = 0, wrong = 0, wrong_color = 0;
  for (int y = 8; y < 232; ++y) {
    for (int x = 8; x < 312; ++x) {
      if (inside(y, x) == 0) continue;
      ++compared;
      const double z = truth.depth_m(y, x);
      const double measured = read.frame.depth.at<std::uint16_t>(y, x) * double{read.frame.meters_per_unit};
      if (measured == 0) ++without;
      // Between the depths of the neighbours, as far as the steps of the Kinect tell.
      const double step = z * z / 351.3;
      const bool is_near = measured >= nearest(y, x) - step && measured <= farthest(y, x) + step;
      if (measured != 0 && !is_near) ++wrong;
      const auto pixel = read.frame.color.at<cv::Vec3b>(y, x);
      const bool is_reddish = pixel[2] > 2 * pixel[0] && pixel[2] > 2 * pixel[1],
                 is_box = truth.labels(y, x) == 3;
      if (is_reddish != (is_box && truth.instances(y, x) == 1)) ++wrong_color;
    }
  }
  EXPECT_GT(compared, 40000);
  EXPECT_LT(without, compared / 6)
      << "only the shadow beside a box, and what the depth camera is too narrow for";
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(wrong_color, 0);
}

TEST(NyuRawFolder, SkipsFrames_WhenAFileIsDamaged) {
  const TemporaryFolder folder;
  const NyuRoom room({320, 240});
  writeNyuScene(folder.path(), room, 5);
  truncate(folder / nyuName('d', 1), 0.5);
  truncate(folder / nyuName('r', 2), 0.5);
  folder.write(nyuName('d', 3), "");
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 5U);
  for (const auto& [index, name] :
       {std::pair{1U, nyuName('d', 1)}, {2U, nyuName('r', 2)}, {3U, nyuName('d', 3)}}) {
    EXPECT_EQ(reads[index].status, Status::skipped) << index;
    EXPECT_THAT(reads[index].error.message(), HasSubstr(name));
  }
  EXPECT_EQ(reads[0].status, Status::frame);
  EXPECT_EQ(reads[4].status, Status::frame);
  EXPECT_EQ(reads[4].frame.index, 4);
}

TEST(NyuRawFolder, SaysSo_WhenTheBytesAreNotSwapped) {
  const TemporaryFolder folder;
  cv::Mat1w swapped(240, 320);
  for (std::uint16_t& value : swapped) value = 917 >> 8 | (917 & 0xFF) << 8;
  writeSwappedPgm(folder / nyuName('d', 0), swapped);
  EXPECT_THAT(openError(folder.path()), AllOf(HasSubstr("2047"), HasSubstr("swapped")));
}

TEST(NyuRawFolder, RefusesImages_WhenTheirFormIsAnother) {
  const TemporaryFolder wide, narrow;
  writeSwappedPgm(wide / nyuName('d', 0), cv::Mat1w(240, 400, 900));
  EXPECT_THAT(openError(wide.path()), HasSubstr("400x240"));
  narrow.write(nyuName('d', 0), "P5 4 3 255\n" + std::string(12, 'x'));
  EXPECT_THAT(openError(narrow.path()), HasSubstr("16-bit"));
}

TEST(NyuRawFolder, IsDepthOnly_WhenColorIsMissing) {
  const TemporaryFolder folder;
  writeSwappedPgm(folder / nyuName('d', 0), NyuRoom({320, 240}).rawDepth(0));
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame);
  EXPECT_TRUE(read.frame.color.empty());
}

}  // namespace
}  // namespace scantrove
