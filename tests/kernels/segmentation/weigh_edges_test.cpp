#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "core/segmentation/edge_keys.h"
#include "core/segmentation/edge_weigher.h"
#include "tests/reference/plane_scene.h"
#include "tests/reference/weigh_edges_reference.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

using reference::toEigen;

constexpr std::array<std::array<int, 2>, EDGE_DIRECTIONS> kSteps = {{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

SurfaceMaps upload(ComputeContext& compute, const Intrinsics& K, const std::vector<cl_float4>& vertices,
                   const std::vector<cl_float4>& normals) {
  SurfaceMaps surface;
  surface.K = K;
  surface.vertices_world = Buffer<cl_float4>(compute.context(), vertices.size());
  surface.normals_world = Buffer<cl_float4>(compute.context(), normals.size());
  surface.vertices_world.write(compute.queue(), vertices);
  surface.normals_world.write(compute.queue(), normals);
  return surface;
}

EdgeKeys weigh(ComputeContext& compute, const SurfaceMaps& surface, const SegmentationParams& params) {
  Result<EdgeWeigher> weigher = EdgeWeigher::create(compute);
  EXPECT_TRUE(weigher) << weigher.error().message();
  EdgeKeys edges;
  weigher->weigh(surface, surface.normals_world, params, edges);
  return edges;
}

/// Checks the weights of edges across the crease of a wedge in all four directions.
void expectCreaseWeight(ComputeContext& compute, bool convex, double turn_rad, bool level, double normal_sign,
                        double expected) {
  const Intrinsics K{300, 300, 31.5F, 23.5F, 64, 48};
  reference::RenderedFaces scene = reference::render(reference::wedge(convex, turn_rad, level), K);
  for (cl_float4& n : scene.normals) {
    for (int axis = 0; axis < 3; ++axis) n.s[axis] *= static_cast<float>(normal_sign);
  }
  const EdgeKeys edges = weigh(compute, upload(compute, K, scene.vertices, scene.normals), {});
  int crossing = 0;
  for (int y = 0; y < K.height; ++y) {
    for (int x = 0; x < K.width; ++x) {
      for (std::size_t direction = 0; direction < EDGE_DIRECTIONS; ++direction) {
        const int x_j = x + kSteps[direction][0], y_j = y + kSteps[direction][1];
        if (x_j < 0 || x_j >= K.width || y_j >= K.height) continue;
        const auto i = static_cast<std::size_t>(y * K.width + x);
        const auto j = static_cast<std::size_t>(y_j * K.width + x_j);
        const float weight = edgeWeight(edges.keys[i].s[direction]);
        if (scene.faces[i] == scene.faces[j]) {
          EXPECT_EQ(weight, 0.0F);
        } else {
          ++crossing;
          EXPECT_NEAR(weight, expected, expected / 1024)
              << "direction " << direction;  // 1/2048 from the key, and float rounding
        }
      }
    }
  }
  EXPECT_GT(crossing, K.height * 2);
}

TEST(WeighEdges, DistinguishesConvexFromConcaveCreases) {
  test::onEachWidth([](ComputeContext& compute) {
    for (const double turn_rad : {0.3, 0.9, 1.5}) {
      for (const bool level : {false, true}) {
        const double bend = 1 - std::cos(turn_rad);
        expectCreaseWeight(compute, true, turn_rad, level, 1, bend * bend);
        expectCreaseWeight(compute, false, turn_rad, level, 1, bend);
        // With normals away from the camera, convex and concave are exchanged.
        expectCreaseWeight(compute, true, turn_rad, level, -1, bend);
        expectCreaseWeight(compute, false, turn_rad, level, -1, bend * bend);
      }
    }
  });
}

TEST(WeighEdges, EqualsTheFormula) {
  // An image of odd size of a bumpy surface with holes, NaN and steps; world and camera frames differ.
  const Intrinsics K{260, 262, 157.2F, 118.4F, 317, 233};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> noise(-1, 1);
  const Eigen::Isometry3d T_world_camera =
      Eigen::Translation3d(1, -2, 0.5) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<cl_float4> vertices, normals;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const float z = 1 + 0.5F * static_cast<float>((u / 40 + v / 30) % 2) + 0.003F * noise(random);
      const Eigen::Vector3d p =
          T_world_camera * K.backProject(static_cast<float>(u), static_cast<float>(v), z).cast<double>();
      const Eigen::Vector3d n = T_world_camera.linear() *
                                Eigen::Vector3d(0.4 * noise(random), 0.4 * noise(random), -1).normalized();
      vertices.push_back(
          {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1}});
      normals.push_back(
          {{static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z()), 1}});
      switch (random() % 40) {
        case 0:
          vertices.back() = normals.back() = {{0, 0, 0, 0}};
          break;
        case 1:
          normals.back() = {{0, 0, 0, 0}};
          break;
        case 2:
          vertices.back() = {{nan, nan, nan, 1}};
          break;
        case 3:
          normals.back() = {{nan, nan, nan, 1}};
          break;
        case 4:
          vertices.back() = {{nan, nan, nan, nan}};
          break;
        default:
          break;
      }
    }
  }
  const auto present = [&](std::size_t i) {
    return vertices[i].s[3] > 0 && normals[i].s[3] > 0 && toEigen(vertices[i]).allFinite() &&
           toEigen(normals[i]).allFinite();
  };
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  test::onEachWidth([&](ComputeContext& compute) {
    for (const int neighbors : {4, 8}) {
      SegmentationParams params;
      params.neighbors = neighbors;
      SurfaceMaps surface = upload(compute, K, vertices, normals);
      surface.T_world_camera = T_world_camera;
      const EdgeKeys edges = weigh(compute, surface, params);
      int joined = 0, separate = 0;
      for (int y = 0; y < K.height; ++y) {
        for (int x = 0; x < K.width; ++x) {
          const auto i = static_cast<std::size_t>(y * K.width + x);
          ASSERT_EQ(edges.depths_m[i] > 0, present(i));
          if (present(i)) {
            ASSERT_NEAR(edges.depths_m[i], (T_camera_world * toEigen(vertices[i])).z(), 2e-6);
          }
          for (std::size_t direction = 0; direction < EDGE_DIRECTIONS; ++direction) {
            const int x_j = x + kSteps[direction][0], y_j = y + kSteps[direction][1];
            const std::uint16_t key = edges.keys[i].s[direction];
            const auto j = static_cast<std::size_t>(y_j * K.width + x_j);
            if (x_j < 0 || x_j >= K.width || y_j >= K.height || !present(i) || !present(j) ||
                (neighbors == 4 && direction >= 2)) {
              ASSERT_EQ(key, kEdgeNever);
              continue;
            }
            const Eigen::Vector3d v_i = toEigen(vertices[i]), v_j = toEigen(vertices[j]);
            const Eigen::Vector3d n_i = toEigen(normals[i]), n_j = toEigen(normals[j]);
            const double z = std::min((T_camera_world * v_i).z(), (T_camera_world * v_j).z());
            const double d_max = std::max<double>(params.max_distance_factor * z / std::min(K.fx, K.fy),
                                                  params.min_max_distance_m);
            // Float rounding of about 1e-7 m may change the result of both comparisons.
            if (std::abs((v_i - v_j).norm() - d_max) < 1e-6 || std::abs((v_j - v_i).dot(n_j)) < 1e-6)
              continue;
            const std::optional<double> expected = reference::edgeWeight(v_i, n_i, v_j, n_j, d_max);
            if (!expected) {
              ++separate;
              ASSERT_EQ(key, kEdgeNever);
              continue;
            }
            ++joined;
            ASSERT_NE(key, kEdgeNever);
            // 1/2048 from the key; 4e-7 from float normals that are not exactly of unit length.
            ASSERT_NEAR(edgeWeight(key), *expected, *expected / 1024 + 4e-7);
          }
        }
      }
      EXPECT_GT(joined, 100000);
      EXPECT_GT(separate, 1000);
    }
  });
}

TEST(WeighEdges, HasNoEdges_InAnEmptyFrame) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K{100, 100, 8, 6, 17, 13};
    const std::vector<cl_float4> no_surface(17 * 13, cl_float4{{0, 0, 0, 0}});
    const EdgeKeys edges = weigh(compute, upload(compute, K, no_surface, no_surface), {});
    for (const cl_ushort4& keys : edges.keys) {
      for (const cl_ushort key : keys.s) EXPECT_EQ(key, kEdgeNever);
    }
    EXPECT_EQ(edges.depths_m, std::vector<float>(17 * 13, 0.0F));
    EXPECT_TRUE(weigh(compute, SurfaceMaps{}, {}).keys.empty());
  });
}

}  // namespace
}  // namespace scantrove
