// A BOP export is a recording again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/open_input.h"
#include "tests/support/captured_log.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

TEST(BopRoundTrip, GivesTheExportedFramesBack) {
  for (const float meters_per_unit : {0.001F, 0.0002F}) {
    const Exported exported(DatasetFormat::bop,
                            [&](ScannedScene& scene) { scene.meters_per_unit = meters_per_unit; });
    const CapturedLog log;
    const auto source = openInput((exported.home / "out").string(), {});
    ASSERT_TRUE(source) << source.error().message();
    const SourceInfo& info = (*source)->info();
    EXPECT_EQ(info.kind, "BOP");
    EXPECT_TRUE(info.has_poses);
    EXPECT_EQ(info.pose_origin, PoseOrigin::truth);
    EXPECT_EQ(info.frame_count, 3);
    EXPECT_EQ(info.intrinsics, exported.scene.K_color) << "depth is that of the colour camera";
    for (const int index : {0, 10, 20}) {
      const FrameRead read = (*source)->next();
      ASSERT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
      EXPECT_EQ(read.frame.index, index);
      EXPECT_FLOAT_EQ(read.frame.meters_per_unit, meters_per_unit);
      EXPECT_FALSE(read.frame.color_camera);
      EXPECT_FALSE(read.frame.intrinsics);
      const Eigen::Isometry3d expected =
          exported.scene.poseOf(index) * exported.scene.T_color_depth.inverse();
      ASSERT_TRUE(read.frame.T_world_camera);
      EXPECT_TRUE(read.frame.T_world_camera->isApprox(expected, 1e-6));
      const std::string name = std::string(index == 0 ? "00000" : "0000") + std::to_string(index);
      const cv::Mat depth = exported.image("000001/depth/" + name + ".png");
      EXPECT_EQ(cv::norm(read.frame.depth, depth, cv::NORM_INF), 0);
      EXPECT_EQ(read.frame.color.size(), cv::Size(640, 480));
    }
    EXPECT_EQ((*source)->next().status, FrameRead::Status::end);
    EXPECT_THAT(log.text(), testing::IsEmpty());
  }
}

}  // namespace
}  // namespace scantrove::test
