// Small BOP scenes, written after the format's document.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/captured_log.h"
#include "tests/unit/capture/benchmark_folder.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

/// scene_camera.json of frames 0 and 7, whose lens and unit differ.
constexpr const char* kBopCameras = R"({
  "0": {"cam_K": [60, 0, 31.5, 0, 61, 23.5, 0, 0, 1], "depth_scale": 0.1,
        "cam_R_w2c": [0, -1, 0, 1, 0, 0, 0, 0, 1], "cam_t_w2c": [100, 200, 300]},
  "7": {"cam_K": [62, 0, 31.5, 0, 63, 23.5, 0, 0, 1], "depth_scale": 0.2}})";

void writeBop(const TemporaryFolder& folder) {
  for (const int i : {0, 7}) {
    writeImage(folder / numbered("000003/rgb/%06d.png", i), tinyColor(i));
    writeImage(folder / numbered("000003/depth/%06d.png", i), tinyDepth(15000));
  }
  folder.write("000003/scene_camera.json", kBopCameras);
}

TEST(BopScene, ReadsCamerasUnitsAndPosesOfFrames) {
  const TemporaryFolder folder;
  writeBop(folder);
  for (const std::filesystem::path& path : {folder / "000003", folder.path()}) {
    const auto source = openBenchmark(path);
    ASSERT_TRUE(source) << path;
    EXPECT_EQ(source->info().kind, "BOP");
    EXPECT_EQ(source->info().intrinsics, (Intrinsics{60, 61, 31.5F, 23.5F, 64, 48}));
    const auto reads = readAll(*source);
    ASSERT_EQ(reads.size(), 2U);
    EXPECT_EQ(reads[1].frame.index, 7);
    const auto depth_m = [&](std::size_t i) {
      return reads[i].frame.depth.at<std::uint16_t>(5, 5) *
             static_cast<double>(reads[i].frame.meters_per_unit);
    };
    EXPECT_NEAR(depth_m(0), 1.5, 1e-5);
    EXPECT_NEAR(depth_m(1), 3, 1e-5);
    ASSERT_TRUE(reads[0].frame.intrinsics);
    EXPECT_EQ(*reads[0].frame.intrinsics, source->info().intrinsics);
    ASSERT_TRUE(reads[1].frame.intrinsics);
    EXPECT_EQ(*reads[1].frame.intrinsics, (Intrinsics{62, 63, 31.5F, 23.5F, 64, 48}));
    // x_camera = R x_world + t: the camera is at -R^T t.
    ASSERT_TRUE(reads[0].frame.T_world_camera);
    EXPECT_TRUE(
        reads[0].frame.T_world_camera->translation().isApprox(Eigen::Vector3d(-0.2, 0.1, -0.3), 1e-9));
    EXPECT_TRUE((*reads[0].frame.T_world_camera * Eigen::Vector3d::UnitX() -
                 reads[0].frame.T_world_camera->translation())
                    .isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
    EXPECT_FALSE(reads[1].frame.T_world_camera);
  }
}

TEST(BopScene, NamesAScene_WhenThereAreSeveral) {
  const TemporaryFolder folder;
  writeBop(folder);
  std::filesystem::copy(folder / "000003", folder / "000004", std::filesystem::copy_options::recursive);
  EXPECT_THAT(openError(folder.path()), HasSubstr((folder / "000003").string()));
}

TEST(BopScene, LeavesOutImagesWithoutCamera_AndNamesABrokenOne) {
  const TemporaryFolder folder;
  writeBop(folder);
  writeImage(folder / "000003/rgb/000009.png", tinyColor(9));
  writeImage(folder / "000003/depth/000009.png", tinyDepth(15000));
  {
    const CapturedLog log;
    const auto source = openBenchmark(folder / "000003");
    ASSERT_TRUE(source);
    EXPECT_EQ(source->info().frame_count, 2);
    EXPECT_THAT(log.text(), HasSubstr("1 of 3 depth images"));
  }
  const auto error = [&](const std::string& json) {
    folder.write("000003/scene_camera.json", json);
    return openError(folder / "000003");
  };
  EXPECT_THAT(error(R"({"0": {"cam_K": [60, 0]}})"),
              AllOf(HasSubstr("scene_camera.json"), HasSubstr("frame 0")));
  EXPECT_THAT(error(R"({"0": {"cam_K": [60,0,31,0,60,23,0,0,1], "depth_scale": 0}})"),
              HasSubstr("depth scale"));
  EXPECT_THAT(error("{"), HasSubstr("scene_camera.json"));
  EXPECT_THAT(error("[1]"), HasSubstr("scene_camera.json"));
  EXPECT_THAT(error("{}"), HasSubstr("no camera for any depth image"));
}

}  // namespace
}  // namespace scantrove
