#include "app/map_instances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/exchange/cloud_writer.h"
#include "core/exchange/recording_writer.h"
#include "core/exchange/trajectory_writer.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

/// A wall 1 m ahead. The left half has depth and shows instance 5, the right half has none and shows 6. The
/// scan's cloud has two measured points of region 1 on the left, and an estimated one of region 2 on the
/// right.
class MapInstancesTest : public testing::Test {
 protected:
  void SetUp() override {
    SourceInfo info;
    info.intrinsics = {300, 300, 159.5F, 119.5F, 320, 240};
    auto writer = RecordingWriter::create(truth_, info);
    ASSERT_TRUE(writer) << writer.error().message();
    RgbdFrame frame;
    frame.T_world_camera = Eigen::Isometry3d::Identity();
    frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 140, 190));
    frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
    frame.depth.colRange(160, 320) = 0;
    frame.instances = cv::Mat(240, 320, CV_16UC1, cv::Scalar(5));
    frame.instances.colRange(160, 320) = 6;
    const auto added = writer->add(frame);
    ASSERT_TRUE(added) << added.error().message();
    ASSERT_TRUE(writeTumTrajectory(scan_ / "trajectory.txt",
                                   std::vector<StampedPose>{{0, Eigen::Isometry3d::Identity()}}));
    const LabeledCloud points{
        {-0.2F, 0, 1, 0, 0, 0, 1}, {-0.1F, 0, 1, 0, 0, 0, 1}, {0.2F, 0, 1, 0, 0, 0, 2, 1}};
    ASSERT_TRUE(writePly(scan_ / "cloud.ply", points));
  }
  [[nodiscard]] PointInstances read(EstimatedPoints estimated = EstimatedPoints::left_out) const {
    const auto instances = readMapInstances(scan_, truth_, estimated);
    EXPECT_TRUE(instances) << instances.error().message();
    EXPECT_TRUE(instances && *instances) << "no frame of the truth belongs to the scan";
    return instances && *instances ? **instances : PointInstances{};
  }

  const TemporaryFolder folder_;
  const std::filesystem::path truth_ = folder_ / "truth", scan_ = folder_.write("scan/x", "").parent_path();
};

TEST_F(MapInstancesTest, LeavesOutEstimatedPoints) {
  EXPECT_THAT(read().predicted, ElementsAre(1, 1));
  EXPECT_THAT(read().truth, ElementsAre(5, 5));
}

TEST_F(MapInstancesTest, EstimatedPointsAreVisible_WhereTheDepthImageIsSilent) {
  EXPECT_THAT(read(EstimatedPoints::included).predicted, ElementsAre(1, 1, 2));
  EXPECT_THAT(read(EstimatedPoints::included).truth, ElementsAre(5, 5, 6));
}

TEST_F(MapInstancesTest, ReadsCloudsOfEarlierVersions) {
  std::string bytes = readText(scan_ / "cloud.ply");
  const std::string property = "property uchar estimated\n";
  bytes.erase(bytes.find(property), property.size());
  // Each of the three points loses its last byte.
  const std::size_t begin = bytes.find("end_header\n") + std::string("end_header\n").size();
  const std::size_t stride = (bytes.size() - begin) / 3;
  for (std::size_t point = 3; point > 0; --point) bytes.erase(begin + point * stride - 1, 1);
  folder_.write("scan/cloud.ply", bytes);
  EXPECT_THAT(read().predicted, ElementsAre(1, 1, 2)) << "all points were measured";
}

TEST_F(MapInstancesTest, ConfidenceIsTheObjectness_AndUnratedRegionsComeLast) {
  EXPECT_TRUE(read().confidence.empty()) << "without labels.json";
  folder_.write("scan/labels.json", R"({"1": {"name": null}, "2": {}})");
  EXPECT_TRUE(read().confidence.empty()) << "without ratings";
  folder_.write("scan/labels.json", R"({"1": {"objectness": -2.5}, "2": {}})");
  EXPECT_THAT(read(EstimatedPoints::included).confidence,
              ElementsAre(Pair(1, -2.5), Pair(2, testing::Lt(-1000))));
}

TEST_F(MapInstancesTest, NamesTheFile_WhenItIsDamaged) {
  const auto failure = [&] {
    const auto instances = readMapInstances(scan_, truth_);
    return instances ? "" : instances.error().message();
  };
  for (const char* text : {"{", R"({"1": {"objectness": "high"}})"}) {
    folder_.write("scan/labels.json", text);
    EXPECT_THAT(failure(), HasSubstr("labels.json"));
  }
  const std::string bytes = readText(scan_ / "cloud.ply");
  folder_.write("scan/cloud.ply", bytes.substr(0, bytes.size() - 1));
  EXPECT_THAT(failure(), HasSubstr("cloud.ply"));
}

}  // namespace
}  // namespace scantrove::test
