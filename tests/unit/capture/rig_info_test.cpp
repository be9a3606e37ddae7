// Folders of BundleFusion and 3RScan: 7-Scenes' names, cameras in a text file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/capture/benchmark_folder.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

std::string rigInfo(const std::string& unit) {
  const std::string place = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
  return "m_versionNumber = 4\nm_sensorName = StructureSensor\nm_colorWidth = 128\nm_colorHeight = 96\n"
         "m_depthWidth = 64\nm_depthHeight = 48\nm_depthShift = " +
         unit +
         "\nm_calibrationColorIntrinsic = 120 0 64 0 0 121 48 0 0 0 1 0 0 0 0 1 \n"
         "m_calibrationColorExtrinsic = " +
         place + " \nm_calibrationDepthIntrinsic = 60 0 31.5 0 0 61 23.5 0 0 0 1 0 0 0 0 1 \n" +
         "m_calibrationDepthExtrinsic = " + place + " \nm_frames.size = 2\n";
}

TEST(BundleFusionFolder, ReadsCamerasAndUnitFromItsInfo) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 2);
  for (int i = 0; i < 2; ++i) {
    std::filesystem::remove(folder / numbered("frame-%06d.color.png", i));
    writeImage(folder / numbered("frame-%06d.color.jpg", i), tinyColor(i, {128, 96}));
  }
  folder.write("info.txt", rigInfo("500"));
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "BundleFusion");
  EXPECT_EQ(source->info().intrinsics, (Intrinsics{60, 61, 31.5F, 23.5F, 64, 48}));
  const FrameRead read = source->next();
  EXPECT_FLOAT_EQ(read.frame.meters_per_unit, 0.002F);
  ASSERT_TRUE(read.frame.color_camera);
  EXPECT_EQ(read.frame.color_camera->K, (Intrinsics{120, 121, 64, 48, 128, 96}));
  folder.write("info.txt", "m_calibrationDepthIntrinsic = 1 2 3\n");
  EXPECT_THAT(openError(folder.path()), AllOf(HasSubstr("info.txt"), HasSubstr("m_depthWidth")));
}

TEST(ThreeRScanFolder, ReadsPgmDepth) {
  const TemporaryFolder folder;
  writeImage(folder / "frame-000000.depth.pgm", tinyDepth(1234));
  writeImage(folder / "frame-000000.color.jpg", tinyColor(1, {128, 96}));
  folder.write("frame-000000.pose.txt", matrixText(1));
  folder.write("_info.txt", rigInfo("1000"));
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "3RScan");
  EXPECT_EQ(source->next().frame.depth.at<std::uint16_t>(5, 5), 1234);
}

TEST(BundleFusionFolder, NamesTheSide_WhenNoImageIsSoLarge) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 1);
  std::string info = rigInfo("500");
  info.replace(info.find("m_depthWidth = 64"), 17, "m_depthWidth = 99999");
  folder.write("info.txt", info);
  EXPECT_THAT(openError(folder.path()), AllOf(HasSubstr("info.txt"), HasSubstr("m_depthWidth")));
}

}  // namespace
}  // namespace scantrove
