#include "core/dataset/mesh_parts.h"

#include <gtest/gtest.h>

#include <random>

#include "core/dataset/up_direction.h"
#include "tests/unit/dataset/scanned_scene.h"

namespace scantrove::test {
namespace {

TEST(SplitByRegion, AssignsAFaceToTheRegionOfTwoOfItsCorners) {
  LabeledMesh mesh;
  for (const std::uint32_t region : {1U, 1U, 2U, 2U, 3U}) {
    SurfacePoint point;
    point.region = region;
    point.position_world_m.x() = static_cast<float>(mesh.vertices.size());
    mesh.vertices.push_back(point);
  }
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {3, 4, 0}, {4, 4, 1}};
  LabeledRegion one, two;
  one.id = 1;
  two.id = 2;
  const auto parts = splitByRegion(mesh, std::vector{one, two});
  EXPECT_EQ(parts.at(1).faces, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(parts.at(1).vertices.size(), 3U);
  // {0, 2, 3} by two corners; {3, 4, 0} has three regions, so the first corner decides.
  EXPECT_EQ(parts.at(2).faces, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_EQ(parts.at(2).vertices[3].position_world_m.x(), 4);
  EXPECT_EQ(parts.at(0).faces.size(), 1U) << "region 3 was not requested";
}

TEST(DiameterOf, EqualsBruteForceOverAllPairs) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (const float flat : {0.01F, 0.5F, 1.0F}) {
    LabeledMesh mesh;
    for (int i = 0; i < 400; ++i) {
      SurfacePoint point;
      point.position_world_m =
          Eigen::Vector3f(normal(random), normal(random), flat * normal(random)).normalized();
      mesh.vertices.push_back(point);
    }
    float brute = 0;
    for (const SurfacePoint& a : mesh.vertices) {
      for (const SurfacePoint& b : mesh.vertices)
        brute = std::max(brute, (a.position_world_m - b.position_world_m).norm());
    }
    EXPECT_EQ(diameterOf(mesh), brute);
  }
  EXPECT_EQ(diameterOf({}), 0);
}

TEST(CheckMesh, Fails_WhenAnIndexOrACoordinateIsInvalid) {
  ScannedScene scene;
  LabeledMesh mesh = *scene.mesh();
  EXPECT_TRUE(checkMesh(mesh));
  mesh.faces[5][1] = static_cast<std::uint32_t>(mesh.vertices.size());
  EXPECT_FALSE(checkMesh(mesh));
  mesh.faces.clear();
  mesh.vertices[3].position_world_m.y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(checkMesh(mesh));
}

TEST(UpDirection, IsPerpendicularToTheTable_WhenTheWorldIsRotated) {
  ScannedScene scene;
  const Eigen::Affine3f turn(Eigen::AngleAxisf(1.1F, Eigen::Vector3f(1, 2, -0.5F).normalized()));
  const LabeledMesh mesh = transformed(*scene.mesh(), turn);
  auto frames = *scene.keyFrames(false);
  for (KeyFrameInfo& frame : frames)
    frame.T_world_depth = Eigen::Isometry3d(turn.cast<double>().matrix()) * frame.T_world_depth;
  const Eigen::Vector3f up = upDirection(frames, mesh);
  EXPECT_GT(up.dot(turn.linear() * Eigen::Vector3f::UnitZ()), 0.9999F) << "within a degree";
  // Without a surface, up follows the cameras: 36 degrees off here, because they look down.
  EXPECT_GT(upDirection(frames, {}).dot(up), 0.75F);
  EXPECT_EQ(upDirection({}, mesh), Eigen::Vector3f::UnitZ());
}

}  // namespace
}  // namespace scantrove::test
