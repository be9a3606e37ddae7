#include <gtest/gtest.h>

#include <random>

#include "tests/support/synthetic_scan.h"

namespace scantrove {
namespace {

using test::SyntheticScan;

/// The region with most pixels of an instance over every 20th frame.
RegionId regionOf(const SyntheticScan& scan, int instance) {
  std::map<int, int> pixels;
  for (std::size_t i = 0; i < scan.frames.size(); i += 20) {
    const cv::Mat regions = scan.finalRegions(scan.frames[i]);
    for (int p = 0; p < static_cast<int>(regions.total()); ++p) {
      if (scan.frames[i].instances.ptr<int>()[p] == instance) ++pixels[regions.ptr<int>()[p]];
    }
  }
  pixels.erase(0);
  const auto most = std::ranges::max_element(pixels, {}, [](const auto& one) { return one.second; });
  return most == pixels.end() ? RegionId{} : RegionId{static_cast<std::uint32_t>(most->first)};
}

// Compares the coverage of each object of a table top with the true view directions, from exact poses and
// instances and caps of ViewCoverage::kReach_deg. Less than a tenth of the sphere may differ.
TEST(Coverage, MatchesTheTrueViewDirections) {
  SyntheticOptions options;
  options.frames = 720;  // the camera moves around the table
  options.stride = 8;
  SyntheticScan scan(options, {}, PoseUse::given);  // true poses, as the steps are wide
  scan.run();
  ASSERT_EQ(scan.frames.size(), 90U);

  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Vector3f> sphere;
  for (int i = 0; i < 4000; ++i)
    sphere.push_back(Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized());

  // The world frame of the scan is the first camera.
  const Eigen::Isometry3d T_truth_scan =
      scan.frames.front().true_pose * scan.frames.front().pose.T_world_camera.inverse();
  int compared = 0;
  for (const InstanceName& instance : scan.source().scene().instances()) {
    if (!instance.is_object) continue;
    const int id = static_cast<int>(scan.source().scene().find(instance.name));
    const Eigen::Vector3d center = scan.source().scene().boundsOf(static_cast<std::uint16_t>(id)).center();
    std::vector<Eigen::Vector3f> observations;
    for (const SyntheticScan::Frame& frame : scan.frames) {
      if (cv::countNonZero(frame.instances == id) * ObservationRecorder::kMinPart <
          static_cast<int>(frame.instances.total()))
        continue;
      observations.emplace_back((frame.true_pose.translation() - center).normalized().cast<float>());
    }
    const RegionId region = regionOf(scan, id);
    if (observations.empty() || !region) continue;
    const ViewCoverage coverage = scan.pipeline().labels().table().seenFrom(region);
    const float least = std::cos(ViewCoverage::kReach_deg * static_cast<float>(M_PI) / 180);
    int different = 0;
    int seen = 0;
    for (const Eigen::Vector3f& direction : sphere) {
      const bool is_seen = std::ranges::any_of(
          observations, [&](const Eigen::Vector3f& observed) { return observed.dot(direction) >= least; });
      const Eigen::Vector3f in_scan =
          (T_truth_scan.linear().transpose() * direction.cast<double>()).cast<float>();
      seen += is_seen ? 1 : 0;
      different += is_seen != coverage.covers(in_scan) ? 1 : 0;
    }
    std::cout << instance.name << ": true " << seen / 4000.0 << ", measured " << coverage.share()
              << ", different " << different / 4000.0 << '\n';
    EXPECT_LT(different, 400) << instance.name;
    ++compared;
  }
  EXPECT_GE(compared, 5);
}

}  // namespace
}  // namespace scantrove
