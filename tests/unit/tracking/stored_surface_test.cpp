#include "core/tracking/stored_surface.h"

#include <gtest/gtest.h>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

const Intrinsics kCamera{131, 131, 79.5F, 59.5F, 160, 120};

/// The vertices of the plane n . x = d (camera frame) in view.
std::vector<cl_float4> planeSeen(const Eigen::Vector3f& n, float d) {
  std::vector<cl_float4> vertices(static_cast<std::size_t>(kCamera.pixels()));
  for (int i = 0; i < kCamera.pixels(); ++i) {
    const Eigen::Vector3f ray =
        kCamera.backProject(static_cast<float>(i % kCamera.width), static_cast<float>(i / kCamera.width), 1);
    const Eigen::Vector3f v = d / n.dot(ray) * ray;
    vertices[static_cast<std::size_t>(i)] = {{v.x(), v.y(), v.z(), 1}};
  }
  return vertices;
}

Eigen::Vector3f xyz(const cl_float4& v) { return {v.s[0], v.s[1], v.s[2]}; }

TEST(StoredSurface, RendersAPlaneWithItsNormal) {
  const Eigen::Vector3f n = Eigen::Vector3f(0.2F, 0.3F, -1).normalized();
  const std::vector<cl_float4> seen = planeSeen(n, -1.5F);
  const Eigen::Isometry3d T = pose(10, 20, 30, 0.5, -0.2, 1);
  const RenderedView view = StoredSurface(kCamera, seen).render(T);
  const Eigen::Vector3f normal = T.linear().cast<float>() * n;
  int normals = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    // Depth has steps of 0.0625 mm; rays at the corners are 1.3 times as long.
    EXPECT_LT((view.vertices_world[i].head<3>() - T.cast<float>() * xyz(seen[i])).norm(), 0.0001F);
    if (view.normals_world[i].w() == 0) continue;
    ++normals;
    // Two steps of 0.0625 mm over two pixels, 23 mm apart.
    EXPECT_GT(view.normals_world[i].head<3>().dot(normal), 0.9999F);
  }
  EXPECT_EQ(normals, 158 * 118) << "all but the border pixels";
}

TEST(StoredSurface, HasNoNormalAtDepthStepsAndNoVertexWithoutDepth) {
  std::vector<cl_float4> seen = planeSeen({0, 0, -1}, -1);
  const std::vector<cl_float4> behind = planeSeen({0, 0, -1}, -1.2F);
  for (int i = 0; i < kCamera.pixels(); ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    if (i % kCamera.width >= 80) seen[pixel] = behind[pixel];
    if (i / kCamera.width < 10) seen[pixel] = {};
  }
  const RenderedView view = StoredSurface(kCamera, seen).render(Eigen::Isometry3d::Identity());
  const auto at = [](int u, int v) { return static_cast<std::size_t>(v * kCamera.width + u); };
  EXPECT_EQ(view.vertices_world[at(40, 5)].w(), 0);
  EXPECT_EQ(view.normals_world[at(79, 60)].w(), 0);
  EXPECT_EQ(view.normals_world[at(80, 60)].w(), 0);
  EXPECT_EQ(view.normals_world[at(78, 60)].z(), -1);
  EXPECT_EQ(view.normals_world[at(40, 10)].w(), 0) << "its upper neighbour has no depth";
}

TEST(StoredSurface, HasNoVertices_BeyondItsRange) {
  const RenderedView view =
      StoredSurface(kCamera, planeSeen({0, 0, -1}, -9)).render(Eigen::Isometry3d::Identity());
  for (const Eigen::Vector4f& vertex : view.vertices_world) EXPECT_EQ(vertex.w(), 0);
  EXPECT_TRUE(StoredSurface().empty());
}

}  // namespace
}  // namespace scantrove::test
