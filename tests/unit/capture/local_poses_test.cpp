#include "core/capture/local_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <string>
#include <vector>

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class ListedPoses final : public FrameSource {
 public:
  explicit ListedPoses(std::deque<Eigen::Vector3d> positions) : positions_(std::move(positions)) {}
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override {
    FrameRead read;
    if (positions_.empty()) return read;
    read.status = FrameRead::Status::frame;
    read.frame.index = number_++;
    read.frame.T_world_camera = Eigen::Isometry3d(Eigen::Translation3d(positions_.front()));
    positions_.pop_front();
    return read;
  }

 private:
  SourceInfo info_;
  std::deque<Eigen::Vector3d> positions_;
  int number_ = 0;
};

struct Reading {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::string> refusals;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

Reading readAll(std::deque<Eigen::Vector3d> positions, const std::optional<Eigen::Vector3d>& origin = {}) {
  LocalPoses source(std::make_unique<ListedPoses>(std::move(positions)), origin);
  Reading reading;
  for (FrameRead read = source.next(); read.status != FrameRead::Status::end; read = source.next()) {
    if (read.status == FrameRead::Status::frame)
      reading.positions.emplace_back(read.frame.T_world_camera->translation());
    else
      reading.refusals.push_back(read.error.message());
  }
  reading.origin = source.origin();
  return reading;
}

TEST(LocalPoses, KeepsFramesWithoutTheirPoses_WhereTheseArePredictions) {
  LocalPoses source(std::make_unique<ListedPoses>(std::deque<Eigen::Vector3d>{
                        {500000, 0, 0}, {500000.5, 0, 0}, {1e20, 0, 0}, {500001, 0, 0}}),
                    std::nullopt, LocalPoses::Implausible::without_pose);
  std::vector<bool> have_pose;
  for (FrameRead read = source.next(); read.status != FrameRead::Status::end; read = source.next()) {
    ASSERT_EQ(read.status, FrameRead::Status::frame);
    have_pose.push_back(read.frame.T_world_camera.has_value());
  }
  EXPECT_THAT(have_pose, ElementsAre(true, true, false, true));
  EXPECT_EQ(source.origin(), Eigen::Vector3d(500000, 0, 0));
}

TEST(LocalPoses, SetsOriginInWholeMeters_WhenTheFirstPoseIsFarAway) {
  const Reading reading = readAll({{5600000.25, -3.5, 0.125}, {5600001.5, -3.5, 0.125}});
  EXPECT_EQ(reading.origin, Eigen::Vector3d(5600000, -4, 0));
  EXPECT_THAT(reading.positions,
              ElementsAre(Eigen::Vector3d(0.25, 0.5, 0.125), Eigen::Vector3d(1.5, 0.5, 0.125)));
}

TEST(LocalPoses, KeepsTheOriginOfTheRecording_WhenTheFirstPoseIsNear) {
  const Reading reading = readAll({{40.25, 1, 2}});
  EXPECT_EQ(reading.origin, Eigen::Vector3d::Zero());
  EXPECT_THAT(reading.positions, ElementsAre(Eigen::Vector3d(40.25, 1, 2)));
}

TEST(LocalPoses, KeepsTheOriginOfTheScan_WhenItContinues) {
  const Reading reading = readAll({{5600002.5, 0, 0}}, Eigen::Vector3d(5600000, -4, 0));
  EXPECT_THAT(reading.positions, ElementsAre(Eigen::Vector3d(2.5, 4, 0)));
}

TEST(LocalPoses, SkipsAPose_WhenItIsImpossible) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Reading reading = readAll({{1e12, 0, 0}, {0, 1e300, 0}, {0, 0, kNan}, {1, 1, 1}});
  EXPECT_THAT(reading.positions, ElementsAre(Eigen::Vector3d(1, 1, 1)));
  ASSERT_THAT(reading.refusals, SizeIs(3));
  EXPECT_THAT(reading.refusals[0], HasSubstr("frame 0 lies 1e+09 km"));
  EXPECT_THAT(reading.refusals[2], HasSubstr("frame 2 is not finite"));
}

TEST(LocalPoses, SkipsAPose_WhenItJumpsAndReturns) {
  const Reading reading = readAll({{0, 0, 0}, {900, 0, 0}, {1, 0, 0}});
  EXPECT_THAT(reading.positions, SizeIs(2));
  ASSERT_THAT(reading.refusals, SizeIs(1));
  EXPECT_THAT(reading.refusals[0], HasSubstr("frame 1 jumps by 900 m"));
}

TEST(LocalPoses, ContinuesElsewhere_WhenSeveralFramesAgree) {
  const Reading reading = readAll({{0, 0, 0}, {900, 0, 0}, {901, 0, 0}, {902, 0, 0}, {903, 0, 0}});
  EXPECT_THAT(reading.positions, SizeIs(3));
}

TEST(LocalPoses, SkipsAPose_WhenItIsTooFarForOneMap) {
  const Reading reading = readAll({{0, 0, 0}, {9000, 0, 0}, {9001, 0, 0}, {9002, 0, 0}, {9003, 0, 0}});
  EXPECT_THAT(reading.positions, SizeIs(1));
  EXPECT_THAT(reading.refusals.at(0), HasSubstr("9 km from where the scan began"));
}

}  // namespace
}  // namespace scantrove::test
