#include "core/editing/surface_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace scantrove::test {
namespace {

constexpr float kVoxel_m = 0.006F;

/// A floor of `side` x `side` voxels with a box of `box` voxels on it, in its middle: top and four walls.
/// Normals turn within two voxels, as a fused surface's do. Fragment 1.
SurfaceGraph boxOnFloor(int side, int box) {
  std::vector<SurfaceVoxel> voxels;
  const int first = (side - box) / 2, last = first + box - 1;
  const auto inBox = [&](int v) { return v >= first && v <= last; };
  const auto add = [&](int x, int y, int z, const Eigen::Vector3f& normal) {
    voxels.push_back({{x, y, z}, normal.normalized(), FragmentId{1}});
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (!inBox(x) || !inBox(y)) add(x, y, 0, {0, 0, 1});
    }
  }
  for (int z = 1; z <= box; ++z) {
    for (int y = first; y <= last; ++y) {
      for (int x = first; x <= last; ++x) {
        Eigen::Vector3f normal(x == first  ? -1.F
                               : x == last ? 1.F
                                           : 0,
                               y == first  ? -1.F
                               : y == last ? 1.F
                                           : 0,
                               z == box ? 1.F : 0);
        if (normal.norm() == 0) continue;
        add(x, y, z, normal);
      }
    }
  }
  return SurfaceGraph::of(std::move(voxels));
}

std::uint32_t voxelAt(const SurfaceGraph& graph, int x, int y, int z) {
  const auto found = std::ranges::find(graph.voxels, Eigen::Vector3i(x, y, z), &SurfaceVoxel::voxel);
  return static_cast<std::uint32_t>(found - graph.voxels.begin());
}

TEST(SurfaceGraph, WeighsByEquation3_5) {
  // Two voxels side by side along x whose normals lean by 0.3 rad towards or away from each other.
  const auto weightOf = [](float lean) {
    return SurfaceGraph::of({{{0, 0, 0}, {std::sin(lean), 0, std::cos(lean)}, FragmentId{1}},
                             {{1, 0, 0}, {-std::sin(lean), 0, std::cos(lean)}, FragmentId{1}}})
        .edges.at(0)
        .weight;
  };
  const float concave = 1 - std::cos(0.6F);
  EXPECT_NEAR(weightOf(0.3F), concave, 1e-5F) << "a valley";
  EXPECT_NEAR(weightOf(-0.3F), concave * concave, 1e-5F) << "a ridge";
}

TEST(SurfaceGraph, VoxelsAreNeighbors_WhenTheyTouchAtACorner) {
  const SurfaceGraph graph = SurfaceGraph::of({{{0, 0, 0}, {0, 0, 1}, FragmentId{1}},
                                               {{-1, -1, 1}, {0, 0, 1}, FragmentId{1}},
                                               {{2, 0, 0}, {0, 0, 1}, FragmentId{1}}});
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_NEAR(graph.edges[0].length, std::sqrt(3.0F), 1e-6F);
}

TEST(SurfaceGraph, Around_FindsVoxelsInTheRadiusOrElseTheNearest) {
  const SurfaceGraph graph = boxOnFloor(20, 6);
  const Eigen::Vector3f corner = Eigen::Vector3f::Constant(0.5F * kVoxel_m);
  EXPECT_EQ(graph.around(corner, kVoxel_m, 1.1F * kVoxel_m).size(), 3U) << "the voxel and two beside it";
  EXPECT_EQ(graph.around(corner - Eigen::Vector3f(0, 0, 0.1F), kVoxel_m, 0.01F),
            std::vector{voxelAt(graph, 0, 0, 0)});
}

// One click on each side is enough: the cut follows the fold instead of enclosing the clicked voxel.
TEST(SplitSurface, DividesABoxFromTheFloorAlongTheFold) {
  const SurfaceGraph graph = boxOnFloor(60, 16);
  const std::uint32_t floor = voxelAt(graph, 5, 30, 0), top = voxelAt(graph, 30, 30, 16);
  const std::vector<std::uint8_t> side = splitSurface(graph, std::span(&floor, 1), std::span(&top, 1));
  int wrong = 0;
  for (std::size_t i = 0; i < graph.voxels.size(); ++i)
    wrong += (side[i] != 0) != (graph.voxels[i].voxel.z() > 0) ? 1 : 0;
  // The lowest ring of the walls, and the floor beside it, may go either way: 2 * 4 * 16 of 4,900.
  EXPECT_LE(wrong, 130);
}

// A smooth surface has no fold, so the cut runs midway between both clicks.
TEST(SplitSurface, DividesAPlaneInTheMiddle) {
  std::vector<SurfaceVoxel> voxels;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 60; ++x) voxels.push_back({{x, y, 0}, {0, 0, 1}, FragmentId{1}});
  }
  const SurfaceGraph graph = SurfaceGraph::of(std::move(voxels));
  const std::uint32_t here = voxelAt(graph, 10, 15, 0), there = voxelAt(graph, 49, 15, 0);
  const std::vector<std::uint8_t> side = splitSurface(graph, std::span(&here, 1), std::span(&there, 1));
  for (std::size_t i = 0; i < graph.voxels.size(); ++i) {
    const int x = graph.voxels[i].voxel.x();
    if (x >= 22 && x <= 37) continue;
    EXPECT_EQ(side[i], x > 37 ? 1 : 0) << x;
  }
}

TEST(SplitSurface, AssignsVoxelsToTheFirstSide_WhenTheyTouchNeither) {
  const SurfaceGraph graph = SurfaceGraph::of({{{0, 0, 0}, {0, 0, 1}, FragmentId{1}},
                                               {{1, 0, 0}, {0, 0, 1}, FragmentId{1}},
                                               {{9, 0, 0}, {0, 0, 1}, FragmentId{1}}});
  const std::uint32_t here = 0, there = 1;
  EXPECT_EQ(splitSurface(graph, std::span(&here, 1), std::span(&there, 1)),
            (std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(SegmentSurface, SeparatesTheBoxFromTheFloor_WhenKIsSmall) {
  const SurfaceGraph graph = boxOnFloor(60, 16);
  EXPECT_EQ(std::ranges::max(segmentSurface(graph, 1e6F, 50)), 0U) << "a large k: one part";
  const std::vector<std::uint32_t> part = segmentSurface(graph, 0.3F, 50);
  EXPECT_NE(part[voxelAt(graph, 5, 30, 0)], part[voxelAt(graph, 30, 30, 16)]);
  std::map<std::uint32_t, int> sizes;
  for (const std::uint32_t label : part) ++sizes[label];
  for (const auto& [label, size] : sizes) EXPECT_GE(size, 50);
}

}  // namespace
}  // namespace scantrove::test
