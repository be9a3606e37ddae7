// Recordings of the kitchen in the layouts of benchmarks: their frames must be those of the kitchen, and
// neighbouring depth images must agree by their poses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/capture/depth_plausibility.h"
#include "tests/support/recordings.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using Status = FrameRead::Status;

double depthAt(const RgbdFrame& frame, int u, int v) {
  return frame.depth.at<std::uint16_t>(v, u) * static_cast<double>(frame.meters_per_unit);
}

/// Median of |warped - measured| in metres when depth of `from` is seen from `to`; NaN without overlap.
double warpError_m(const RgbdFrame& from, const RgbdFrame& to, const Intrinsics& K) {
  const Eigen::Isometry3d T_to_from = to.T_world_camera->inverse() * *from.T_world_camera;
  std::vector<double> errors;
  for (int v = 0; v < K.height; v += 4) {
    for (int u = 0; u < K.width; u += 4) {
      const double z = depthAt(from, u, v);
      if (z <= 0) continue;
      const Eigen::Vector3d p =
          T_to_from *
          K.backProject(static_cast<float>(u), static_cast<float>(v), static_cast<float>(z)).cast<double>();
      if (p.z() < 0.05) continue;
      const auto x = static_cast<int>(
          std::lround(static_cast<double>(K.fx) * p.x() / p.z() + static_cast<double>(K.cx)));
      const auto y = static_cast<int>(
          std::lround(static_cast<double>(K.fy) * p.y() / p.z() + static_cast<double>(K.cy)));
      if (!K.isInside(x, y) || depthAt(to, x, y) <= 0) continue;
      errors.push_back(std::abs(depthAt(to, x, y) - p.z()));
    }
  }
  if (errors.empty()) return NAN;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

constexpr double kEnd_m = 9.99;

struct Expected {
  std::string kind;
  std::size_t frames = 0;
  bool has_poses = true;
  double rounding_m = 1e-6;
};

/// Compares with the kitchen from frame 150 on. Replica's units end at 10 m.
std::vector<FrameRead> expectKitchen(const std::filesystem::path& path,
                                     const std::filesystem::path& kitchen_path, const Expected& expected,
                                     const SourceOptions& options = {}) {
  const auto source = openSource(path.string(), options);
  SourceOptions of_kitchen;
  of_kitchen.start = 150;
  const auto kitchen = openSource(kitchen_path.string(), of_kitchen);
  if (!source || !kitchen) {
    ADD_FAILURE() << (source ? kitchen.error().message() : source.error().message());
    return {};
  }
  EXPECT_EQ((*source)->info().kind, expected.kind);
  EXPECT_EQ((*source)->info().has_poses, expected.has_poses);
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{585, 585, 320, 240, 640, 480}));
  EXPECT_FALSE((*source)->info().implausible_depth);
  auto reads = readAll(**source);
  EXPECT_EQ(reads.size(), expected.frames);
  for (const FrameRead& read : reads) {
    const FrameRead truth = (*kitchen)->next();
    EXPECT_EQ(read.status, Status::frame) << read.error.message();
    if (read.status != Status::frame) return {};
    for (int v = 3; v < 480; v += 40) {
      for (int u = 3; u < 640; u += 40) {
        const double depth_m = depthAt(truth.frame, u, v);
        if (depth_m < kEnd_m) {
          EXPECT_NEAR(depthAt(read.frame, u, v), depth_m, 1.01 * expected.rounding_m) << u << ' ' << v;
        }
      }
    }
    if (read.frame.T_world_camera) {
      EXPECT_TRUE(read.frame.T_world_camera->isApprox(*truth.frame.T_world_camera, 1e-4));
    }
  }
  return reads;
}

/// Neighbours must agree within 1 % of the depth, and worse with the poses inverted.
void expectAgreement(const std::vector<FrameRead>& reads) {
  const Intrinsics K{585, 585, 320, 240, 640, 480};
  const FrameRead* first = nullptr;
  for (const FrameRead& read : reads) {
    if (!read.frame.T_world_camera) continue;
    if (first == nullptr) first = &read;
  }
  ASSERT_NE(first, nullptr);
  RgbdFrame from = first->frame, to = reads.back().frame;
  ASSERT_TRUE(to.T_world_camera);
  const double error = warpError_m(from, to, K);
  const double depth = *medianDepth(from.depth, static_cast<double>(from.meters_per_unit));
  EXPECT_LT(error, 0.01 * depth);
  from.T_world_camera = from.T_world_camera->inverse();
  to.T_world_camera = to.T_world_camera->inverse();
  const double inverted = warpError_m(from, to, K);
  EXPECT_TRUE(std::isnan(inverted) || inverted > error) << inverted << " and " << error;
}

TEST(BenchmarkRecordings, ReadsScannetsLayout) {
  SCANTROVE_NEED_RECORDING(path, "devices/scannet-from-7scenes");
  SCANTROVE_NEED_RECORDING(kitchen, "kitchen");
  const auto reads = expectKitchen(path, kitchen, {.kind = "ScanNet", .frames = 16});
  ASSERT_EQ(reads.size(), 16U);
  EXPECT_EQ(std::ranges::count_if(reads, [](const FrameRead& r) { return !r.frame.T_world_camera; }), 2);
  EXPECT_FALSE(reads[3].frame.T_world_camera);
  ASSERT_TRUE(reads[0].frame.color_camera);
  EXPECT_EQ(reads[0].frame.color_camera->K, (Intrinsics{1185, 1185, 648, 484, 1296, 968}));
  expectAgreement(reads);
}

TEST(BenchmarkRecordings, ReadsReplicasLayout) {
  SCANTROVE_NEED_RECORDING(path, "devices/replica-from-7scenes");
  SCANTROVE_NEED_RECORDING(kitchen, "kitchen");
  SourceOptions options;
  options.intrinsics = Intrinsics{585, 585, 320, 240, 0, 0};
  const auto reads =
      expectKitchen(path, kitchen, {.kind = "Replica", .frames = 16, .rounding_m = 1 / 6553.5}, options);
  ASSERT_EQ(reads.size(), 16U);
  expectAgreement(reads);
}

TEST(BenchmarkRecordings, ReadsFoundationPosesLayout) {
  SCANTROVE_NEED_RECORDING(path, "devices/foundationpose-from-7scenes");
  SCANTROVE_NEED_RECORDING(kitchen, "kitchen");
  const auto reads =
      expectKitchen(path, kitchen, {.kind = "FoundationPose", .frames = 8, .has_poses = false});
  ASSERT_EQ(reads.size(), 8U);
  EXPECT_NEAR(reads[1].frame.timestamp_s - reads[0].frame.timestamp_s, 1 / 30.0, 1e-4);
}

TEST(BenchmarkRecordings, ReadsAFloatTiff) {
  SCANTROVE_NEED_RECORDING(path, "devices/lidar-tiff");
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "depth");
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".tiff" || extension == ".tif")
      std::filesystem::copy_file(entry, folder / ("depth/0" + extension));
  }
  SourceOptions options;
  options.intrinsics = Intrinsics{212, 212, 128, 96, 0, 0};
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source) << source.error().message();
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame);
  EXPECT_EQ(read.frame.depth.size(), cv::Size(256, 192));
  double least = 0, most = 0;
  cv::minMaxLoc(read.frame.depth, &least, &most);
  const auto unit = static_cast<double>(read.frame.meters_per_unit);
  EXPECT_NEAR(least * unit, 0.18, 0.01);
  EXPECT_NEAR(most * unit, 0.57, 0.01);
}

}  // namespace
}  // namespace scantrove
