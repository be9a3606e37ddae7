#include "core/dataset/up_direction.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/synthetic/synthetic_source.h"
#include "tests/unit/dataset/scanned_scene.h"

namespace scantrove::test {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

/// The same frames from a camera rotated about its optical axis.
std::vector<KeyFrameInfo> rolled(std::vector<KeyFrameInfo> frames, int quarter_turns) {
  for (KeyFrameInfo& frame : frames)
    frame.T_world_depth =
        frame.T_world_depth * Eigen::AngleAxisd(quarter_turns * kQuarterTurn, Eigen::Vector3d::UnitZ());
  return frames;
}

struct Recording {
  std::vector<KeyFrameInfo> frames;
  LabeledMesh mesh;
};

/// Frames of a demo scene, and the points with normals of their depth images.
Recording recordingOf(const std::string& scene) {
  SourceOptions options;
  options.stride = 40;
  options.frames = 8;
  const auto source = makeSyntheticSource(scene, options).value();
  const Intrinsics K = source->info().intrinsics;
  Recording recording;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    KeyFrameInfo info;
    info.T_world_depth = *read.frame.T_world_camera;
    recording.frames.push_back(info);
    const auto pointAt = [&](int u, int v) -> Eigen::Vector3f {
      const float z =
          static_cast<float>(read.frame.depth.at<std::uint16_t>(v, u)) * read.frame.meters_per_unit;
      return z > 0 && z < 4 ? K.backProject(static_cast<float>(u), static_cast<float>(v), z)
                            : Eigen::Vector3f::Zero();
    };
    constexpr int kStep = 8;
    for (int v = kStep; v < K.height - kStep; v += kStep) {
      for (int u = kStep; u < K.width - kStep; u += kStep) {
        const Eigen::Vector3f here = pointAt(u, v), right = pointAt(u + kStep, v),
                              left = pointAt(u - kStep, v), below = pointAt(u, v + kStep),
                              above = pointAt(u, v - kStep);
        if (here.isZero() || right.isZero() || left.isZero() || below.isZero() || above.isZero()) continue;
        const Eigen::Isometry3f T = info.T_world_depth.cast<float>();
        SurfacePoint point;
        point.position_world_m = T * here;
        point.normal_world = T.linear() * (below - above).cross(right - left).normalized();
        recording.mesh.vertices.push_back(point);
      }
    }
  }
  return recording;
}

class UpDirectionTest : public testing::TestWithParam<const char*> {};

TEST_P(UpDirectionTest, IsUpInTheScene_WhenTheCameraIsRolled) {
  const Recording recording = recordingOf(GetParam());
  ASSERT_GT(recording.mesh.vertices.size(), 10'000U);
  for (int quarter_turns = 0; quarter_turns < 4; ++quarter_turns) {
    const Eigen::Vector3f up = upDirection(rolled(recording.frames, quarter_turns), recording.mesh);
    EXPECT_GT(up.z(), 0.99F) << "turned by " << 90 * quarter_turns << " degrees: " << up.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, UpDirectionTest,
                         testing::Values("tabletop", "tabletop:4", "room", "room:2"));

TEST(UpDirection, IsPerpendicularToTheTable_WhenTheCameraIsRolled) {
  ScannedScene scene;
  const LabeledMesh mesh = *scene.mesh();
  for (int quarter_turns = 0; quarter_turns < 4; ++quarter_turns) {
    const Eigen::Vector3f up = upDirection(rolled(*scene.keyFrames(false), quarter_turns), mesh);
    EXPECT_GT(up.z(), 0.9999F) << "turned by " << 90 * quarter_turns << " degrees: " << up.transpose();
  }
}

TEST(UpDirection, FollowsTheCamera_WhenNoSurfaceIsLevel) {
  ScannedScene scene;
  const auto frames = *scene.keyFrames(false);
  const Eigen::Vector3f upright = upDirection(frames, {});
  EXPECT_LT((upright + upDirection(rolled(frames, 2), {})).norm(), 1e-5F) << "upside down";
}

}  // namespace
}  // namespace scantrove::test
