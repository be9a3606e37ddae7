#include "core/meshing/mesh_extractor.h"

#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "core/fusion/kernels/color_voxel.h"
#include "core/labeling/kernels/label_voxel.h"
#include "tests/kernels/meshing/mesh_checks.h"
#include "tests/support/brick_contents.h"
#include "tests/support/color_rig.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

using test::ColorRig;
using test::PaintedScene;
using Color = std::array<std::uint8_t, 3>;

constexpr float kVoxel_m = 0.01F;
const Intrinsics kCamera{290.0F, 288.0F, 157.3F, 118.1F, 317, 233};

FusionParams meshParams(int budget_mb = 0) {
  FusionParams params;
  params.voxel_size_m = kVoxel_m;
  params.memory_budget_mb = budget_mb;
  return params;
}

PaintedScene twoColored(const test::AnalyticScene& shape) {
  return {shape, [](const Eigen::Vector3d& p) {
            return p.x() < 0 ? Eigen::Vector3d(200, 40, 30) : Eigen::Vector3d(20, 60, 220);
          }};
}

/// 26 cameras around a point, in the directions of the corners, edges and faces of a cube.
std::vector<Eigen::Isometry3d> around(const Eigen::Vector3d& center, double distance) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (direction.isZero()) continue;
    poses.push_back(test::lookAt(center + distance * direction.normalized(), center, {0.11, 0.91, 0.23}));
  }
  return poses;
}

/// Fills seen voxels with a signed distance function (voxels) of the position.
void fillMap(ComputeContext& compute, BrickMap& map,
             const std::function<double(const Eigen::Vector3d&)>& field,
             const std::function<bool(const Eigen::Vector3i& voxel)>& is_seen) {
  std::vector<test::HostVoxel> voxels(static_cast<std::size_t>(map.device().slotEnd()) * BRICK_VOXELS);
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const Eigen::Vector3i local(static_cast<int>(i % 8), static_cast<int>(i / 8 % 8),
                                static_cast<int>(i / 64 % 8));
    const Eigen::Vector3i voxel = 8 * map.device().positionOf(static_cast<int>(i / BRICK_VOXELS)) + local;
    if (!is_seen(voxel)) continue;
    const double value = std::clamp(field(voxel.cast<double>().array() + 0.5) / 4, -1.0, 1.0);
    const auto distance = static_cast<int>(std::lround(DISTANCE_ONE * value));
    voxels[i] = {distance == DISTANCE_UNSEEN ? 1 : distance, 1};
  }
  test::writeVoxels(compute, map, voxels);
}

std::vector<Eigen::Vector3i> cubeOfBricks(int from, int to) {
  std::vector<Eigen::Vector3i> bricks;
  for (int z = from; z < to; ++z) {
    for (int y = from; y < to; ++y) {
      for (int x = from; x < to; ++x) bricks.emplace_back(x, y, z);
    }
  }
  return bricks;
}

SurfaceMesh meshOf(BrickMap& map) {
  std::optional<SurfaceMesh> mesh = extractMesh(map);
  EXPECT_TRUE(mesh);
  return mesh.value_or(SurfaceMesh{});
}

TEST(MeshExtractor, ABallIsClosedAndAccurate) {
  test::onEachDevice([](ComputeContext& compute) {
    const Eigen::Vector3d center(0.013, -0.007, 0.021);  // across eight pages
    const double radius = 0.25;
    test::AnalyticScene ball;
    ball.sphere(center, radius);
    const PaintedScene scene = twoColored(ball);
    ColorRig rig(compute, meshParams());
    for (const Eigen::Isometry3d& T : around(center, 0.8))
      rig.show(scene, kCamera, T, std::nullopt, {634, 466});
    const SurfaceMesh mesh = meshOf(rig.map().bricks());
    test::expectNoFaults(mesh);
    EXPECT_TRUE(test::borderOf(mesh).empty()) << "a hole";
    double farthest = 0;
    double least_cosine = 1;
    int of_wrong_color = 0;
    int without_color = 0;
    for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
      const Eigen::Vector3d from_center = vertex.position.cast<double>() - center;
      farthest = std::max(farthest, std::abs(from_center.norm() - radius));
      least_cosine = std::min(least_cosine, vertex.normal.cast<double>().dot(from_center.normalized()));
      without_color += vertex.has_color ? 0 : 1;
      if (std::abs(vertex.position.x()) < 2 * kVoxel_m) continue;  // near the border of both colours
      const Color expected = vertex.position.x() < 0 ? Color{200, 40, 30} : Color{20, 60, 220};
      for (std::size_t i = 0; i < 3; ++i) {
        of_wrong_color += std::abs(vertex.color[i] - expected[i]) > 15 ? 1 : 0;
      }
    }
    EXPECT_GT(mesh.vertices.size(), 8000U);
    EXPECT_LT(farthest, kVoxel_m / 2);
    EXPECT_GT(least_cosine, 0.9);
    EXPECT_EQ(of_wrong_color, 0);
    EXPECT_EQ(without_color, 0);
    EXPECT_NEAR(test::volumeOf(mesh), 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 0.02 * 0.0654);
  });
}

TEST(MeshExtractor, ABoxOnATableHasNoHoles) {
  test::onEachDevice([](ComputeContext& compute) {
    const double height = 0.0023;  // of the table
    const Eigen::Vector3d low(-0.152, -0.094, height);
    const Eigen::Vector3d high(0.148, 0.106, 0.203);
    test::AnalyticScene table_top;
    table_top.plane({0, 0, height}, {0, 0, 1}).box(low, high);
    const PaintedScene scene = twoColored(table_top);
    ColorRig rig(compute, meshParams());
    for (int ring = 0; ring < 3; ++ring) {
      for (int i = 0; i < 12; ++i) {
        const double turn = 2 * std::numbers::pi * (i + 0.5 * ring) / 12;
        const double rise = 0.45 + 0.45 * ring;
        const Eigen::Vector3d eye = 0.9 * Eigen::Vector3d(std::cos(rise) * std::cos(turn),
                                                          std::cos(rise) * std::sin(turn), std::sin(rise));
        rig.show(scene, kCamera, test::lookAt(eye, {0, 0, 0.08}, {0, 0, 1}), std::nullopt, {634, 466});
      }
    }
    const SurfaceMesh mesh = meshOf(rig.map().bricks());
    test::expectNoFaults(mesh);
    int holes = 0;
    for (const std::uint32_t vertex : test::borderOf(mesh)) {
      const Eigen::Vector3f& p = mesh.vertices[vertex].position;
      holes += p.head<2>().norm() < 0.3 ? 1 : 0;
    }
    EXPECT_EQ(holes, 0);
    double farthest = 0;
    double farthest_on_sides = 0;
    double least_up = 1;
    int of_wrong_color = 0;
    for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
      const Eigen::Vector3d p = vertex.position.cast<double>();
      if (p.head<2>().norm() > 0.3) continue;
      const Eigen::Vector3d outside = (low - p).cwiseMax(p - high);
      const double to_box = outside.cwiseMax(0).norm() + std::min(outside.maxCoeff(), 0.0);
      const double off = std::abs(std::min(to_box, p.z() - height));
      farthest = std::max(farthest, off);
      const auto near_sides = (outside.array().abs() < 3 * kVoxel_m).count();
      if (near_sides < 2) farthest_on_sides = std::max(farthest_on_sides, off);
      const bool on_top = p.z() > 0.15 && outside.head<2>().maxCoeff() < -3 * kVoxel_m;
      if (on_top) least_up = std::min(least_up, static_cast<double>(vertex.normal.z()));
      if (!vertex.has_color || std::abs(p.x()) < 2 * kVoxel_m) continue;
      const Color expected = p.x() < 0 ? Color{200, 40, 30} : Color{20, 60, 220};
      for (std::size_t i = 0; i < 3; ++i)
        of_wrong_color += std::abs(vertex.color[i] - expected[i]) > 15 ? 1 : 0;
    }
    EXPECT_LT(farthest_on_sides, kVoxel_m / 2);
    EXPECT_LT(farthest, kVoxel_m * 3 / 4) << "edges and the foot are rounded by the truncated distance";
    EXPECT_GT(least_up, 0.99);
    EXPECT_EQ(of_wrong_color, 0);
  });
}

TEST(MeshExtractor, HasNoHoles_InARandomField) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, kVoxel_m);
    map.allocate(cubeOfBricks(-2, 2));  // where eight pages meet
    // Noise covers all cases of marching cubes, also at page borders and with zeros.
    std::mt19937 random(5);
    fillMap(
        compute, map, [&](const Eigen::Vector3d&) { return static_cast<int>(random() % 9) - 4; },
        [](const Eigen::Vector3i&) { return true; });
    const SurfaceMesh mesh = meshOf(map);
    EXPECT_GT(mesh.faces.size(), 50000U);
    test::expectNoFaults(mesh);
    int holes = 0;
    for (const std::uint32_t vertex : test::borderOf(mesh)) {
      const Eigen::Vector3f inside = mesh.vertices[vertex].position.cwiseAbs() / kVoxel_m;
      holes += inside.maxCoeff() < 15.4F ? 1 : 0;  // the outermost voxel centres are at 15.5
    }
    EXPECT_EQ(holes, 0);
  });
}

TEST(MeshExtractor, SkipsCells_WithAnUnseenVoxel) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, kVoxel_m);
    map.allocate(cubeOfBricks(-1, 1));
    const auto plane = [](const Eigen::Vector3d& p) { return p.z() - 0.3; };
    const auto all_but_one = [](const Eigen::Vector3i& v) { return v != Eigen::Vector3i(-3, 2, 0); };
    fillMap(compute, map, plane, all_but_one);
    const SurfaceMesh mesh = meshOf(map);
    test::expectNoFaults(mesh);
    // The unseen voxel removes 4 of 15 x 15 cells with two triangles each.
    EXPECT_EQ(mesh.faces.size(), 2U * (15 * 15 - 4));
    for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
      EXPECT_NEAR(vertex.position.z(), 0.3 * kVoxel_m, 1e-5);
      EXPECT_GT(vertex.normal.z(), 0.999);
      EXPECT_FALSE(vertex.has_color);
      EXPECT_FALSE(vertex.fragment);
    }
  });
}

TEST(MeshExtractor, IsEmpty_WhenTheMapIsEmpty) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, kVoxel_m);
    EXPECT_TRUE(meshOf(map) == SurfaceMesh{});
    map.allocate(cubeOfBricks(0, 2));
    EXPECT_TRUE(meshOf(map) == SurfaceMesh{});
  });
}

TEST(MeshExtractor, InterpolatesColorsAndTakesTheNearestLabel) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, kVoxel_m);
    map.allocate(cubeOfBricks(-1, 1));
    fillMap(
        compute, map, [](const Eigen::Vector3d& p) { return p.z() - 0.25; },
        [](const Eigen::Vector3i&) { return true; });
    // Vertices lie three quarters of the way from voxels of z = -1 to voxels of z = 0.
    std::vector<cl_uint> colors(static_cast<std::size_t>(map.device().slotEnd()) * BRICK_VOXELS, 0);
    std::vector<cl_uint> labels(colors.size(), 0);
    const auto at = [&](int x, int y, int z) {
      const int slot = map.device().slotOf({x >> 3, y >> 3, z >> 3});
      return static_cast<std::size_t>(slot) * BRICK_VOXELS +
             static_cast<std::size_t>((x & 7) + 8 * (y & 7) + 64 * (z & 7));
    };
    for (int y = -8; y < 8; ++y) {
      for (int x = -8; x < 8; ++x) {
        if (x < 0) colors[at(x, y, -1)] = COLOR_VOXEL(100U, 0U, 40U, 9U);
        if (x < 0 && y < 0) colors[at(x, y, 0)] = COLOR_VOXEL(200U, 100U, 40U, 9U);
        if (x < 3) labels[at(x, y, -1)] = LABEL_VOXEL(7U, 1U);
        if (x < 3 && y < 0) labels[at(x, y, 0)] = LABEL_VOXEL(8U, 1U);
      }
    }
    map.pools().colors().write(compute.queue(), colors);
    map.pools().labels().write(compute.queue(), labels);
    const SurfaceMesh mesh = meshOf(map);
    EXPECT_EQ(mesh.vertices.size(), 256U);
    for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
      const Eigen::Vector3f p = vertex.position / kVoxel_m;
      // Colour and label extend two voxels beyond the last voxel that has them.
      ASSERT_EQ(vertex.has_color, p.x() < 2);
      ASSERT_EQ(static_cast<bool>(vertex.fragment), p.x() < 5);
      if (p.x() < 0) {
        const Color expected = p.y() < 0 ? Color{175, 75, 40} : Color{100, 0, 40};
        ASSERT_EQ(vertex.color, expected);
      }
      if (p.x() < 3) {
        ASSERT_EQ(vertex.fragment.value, p.y() < 0 ? 8U : 7U);
      }
    }
  });
}

/// Records balls along x, few of them per view.
void recordBalls(ColorRig& rig) {
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d center(0.9 * i, 0, 0);
    test::AnalyticScene ball;
    ball.sphere(center, 0.2);
    for (const double side : {-0.25, 0.0, 0.25}) {
      rig.show(twoColored(ball), kCamera, test::lookAt(center + Eigen::Vector3d(side, 0.1, -0.7), center),
               std::nullopt, {317, 233});
    }
  }
}

TEST(MeshExtractor, IsEqual_WithASmallMemoryBudget) {
  test::onEachDevice([](ComputeContext& compute) {
    ColorRig with_all(compute, meshParams());
    ColorRig with_little(compute, meshParams(1));
    recordBalls(with_all);
    recordBalls(with_little);
    EXPECT_EQ(with_all.map().bricks().storedBytes(), 0U);
    EXPECT_GT(with_little.map().bricks().storedBytes(), 0U);
    const int resident = with_little.map().bricks().device().brickCount();
    EXPECT_LT(2 * resident, with_little.map().bricks().brickCount());
    const SurfaceMesh mesh = meshOf(with_all.map().bricks());
    EXPECT_GT(mesh.vertices.size(), 5000U);
    test::expectNoFaults(mesh);
    EXPECT_GT(std::ranges::count(mesh.vertices, true, &SurfaceMesh::Vertex::has_color), 5000);
    EXPECT_TRUE(meshOf(with_little.map().bricks()) == mesh);
    EXPECT_EQ(with_little.map().bricks().device().brickCount(), resident) << "extraction swaps no bricks in";
  });
}

TEST(MeshExtractor, ReportsProgressAndCanBeCancelled) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, kVoxel_m);
    map.allocate(cubeOfBricks(-9, 9));
    std::vector<double> progress;
    EXPECT_TRUE(extractMesh(map, [&](double done) {
      progress.push_back(done);
      return true;
    }));
    ASSERT_EQ(progress.size(), 65U);  // 64 pages, and the end
    EXPECT_TRUE(std::ranges::is_sorted(progress));
    EXPECT_EQ(progress.front(), 0);
    EXPECT_EQ(progress.back(), 1);
    int calls = 0;
    EXPECT_FALSE(extractMesh(map, [&](double) { return ++calls < 10; }));
    EXPECT_EQ(calls, 10);
  });
}

}  // namespace
}  // namespace scantrove
