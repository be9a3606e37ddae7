#include "core/segmentation/graph_segmenter.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/segmentation/edge_keys.h"
#include "core/segmentation/edge_weigher.h"
#include "tests/reference/graph_partition_reference.h"
#include "tests/reference/plane_scene.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

struct Scene {
  Intrinsics K;
  std::vector<cl_float4> vertices;
  std::vector<cl_float4> normals;
};

SurfaceMaps upload(ComputeContext& compute, const Scene& scene) {
  SurfaceMaps surface;
  surface.K = scene.K;
  surface.vertices_world = Buffer<cl_float4>(compute.context(), scene.vertices.size());
  surface.normals_world = Buffer<cl_float4>(compute.context(), scene.normals.size());
  surface.vertices_world.write(compute.queue(), scene.vertices);
  surface.normals_world.write(compute.queue(), scene.normals);
  return surface;
}

Scene noisyScene(int width, int height, unsigned seed) {
  Scene scene{{60, 60, static_cast<float>(width) / 2, static_cast<float>(height) / 2, width, height}, {}, {}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> noise(-1, 1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float z = 1 + 0.2F * static_cast<float>(u / 9 % 2) + 0.002F * noise(random);
      const Eigen::Vector3f p = scene.K.backProject(static_cast<float>(u), static_cast<float>(v), z);
      const Eigen::Vector3f n =
          Eigen::Vector3f(0.2F * noise(random), 0.5F * static_cast<float>(v / 7 % 2), -1).normalized();
      const float valid = random() % 12 == 0 ? 0.0F : 1.0F;
      scene.vertices.push_back({{p.x() * valid, p.y() * valid, p.z() * valid, valid}});
      scene.normals.push_back({{n.x() * valid, n.y() * valid, n.z() * valid, valid}});
    }
  }
  return scene;
}

SegmentMap segment(ComputeContext& compute, const SurfaceMaps& surface, const SegmentationParams& params) {
  auto segmenter = GraphSegmenter::create(compute);
  EXPECT_TRUE(segmenter) << segmenter.error().message();
  return (*segmenter)->segment(surface, params);
}

/// The edges of the pixel graph with their quantised weights, and their keys in the order of edge_layout.h.
std::vector<reference::GraphEdge> edgesOf(ComputeContext& compute, const SurfaceMaps& surface,
                                          const SegmentationParams& params) {
  Result<EdgeWeigher> weigher = EdgeWeigher::create(compute);
  EdgeKeys keys;
  weigher->weigh(surface, surface.normals_world, params, keys);
  const auto width = static_cast<std::uint32_t>(keys.width);
  const std::uint32_t offset[EDGE_DIRECTIONS] = {1, width, width + 1, width - 1};
  std::vector<reference::GraphEdge> edges;
  for (std::uint32_t i = 0; i < keys.keys.size(); ++i) {
    for (std::size_t d = 0; d < EDGE_DIRECTIONS; ++d) {
      if (keys.keys[i].s[d] != kEdgeNever) edges.push_back({i, i + offset[d], edgeWeight(keys.keys[i].s[d])});
    }
  }
  return edges;
}

TEST(GraphSegmenter, EqualsTheLiteralAlgorithm) {
  const Scene scene = noisyScene(27, 19, 2);
  test::onEachDevice([&](ComputeContext& compute) {
    const SurfaceMaps surface = upload(compute, scene);
    for (const float k : {0.003F, 0.05F, 0.5F}) {
      SegmentationParams params{.k = k, .min_pixels = 0, .refine_normals = false};
      params.min_max_distance_m = 0.05F;
      const SegmentMap map = segment(compute, surface, params);
      const reference::LiteralPartition literal(map.ids.size(), edgesOf(compute, surface, params), k);
      std::vector<std::uint32_t> expected;  // ids 1, 2, ... in the order of first pixels; 0 without surface
      std::map<std::uint32_t, std::uint32_t> numbers;
      for (std::size_t i = 0; i < map.ids.size(); ++i) {
        const bool present = scene.vertices[i].s[3] > 0;
        expected.push_back(
            present ? numbers.emplace(literal.components()[i], static_cast<std::uint32_t>(numbers.size() + 1))
                          .first->second
                    : 0);
      }
      ASSERT_EQ(map.ids, expected) << "k " << k;
      EXPECT_GT(map.count(), 3);
    }
  });
}

TEST(GraphSegmenter, LeavesNoSmallSegment_WithANeighbor) {
  const Scene scene = noisyScene(157, 117, 6);
  test::onEachDevice([&](ComputeContext& compute) {
    const SurfaceMaps surface = upload(compute, scene);
    const SegmentationParams params{.k = 0.001F, .min_pixels = 12, .refine_normals = false};
    const SegmentMap map = segment(compute, surface, params);
    for (const reference::GraphEdge& edge : edgesOf(compute, surface, params)) {
      if (map.ids[edge.a] == map.ids[edge.b]) continue;
      EXPECT_GE(std::min(map.areas[map.ids[edge.a]], map.areas[map.ids[edge.b]]), params.min_pixels);
    }
  });
}

TEST(GraphSegmenter, AreasAndIdsAreConsistentAndDeterministic) {
  const Scene scene = noisyScene(317, 233, 8);
  test::onEachDevice([&](ComputeContext& compute) {
    auto segmenter = GraphSegmenter::create(compute);
    ASSERT_TRUE(segmenter) << segmenter.error().message();
    const SurfaceMaps surface = upload(compute, scene);
    const SegmentMap first = (*segmenter)->segment(surface, {});
    const SurfaceMaps smaller = upload(compute, noisyScene(40, 30, 1));
    EXPECT_EQ((*segmenter)->segment(smaller, {}).ids.size(), 1200U);
    const SegmentMap again = (*segmenter)->segment(surface, {});
    EXPECT_EQ(first.ids, again.ids);
    EXPECT_EQ(first.areas, again.areas);

    std::vector<int> areas(first.areas.size(), 0);
    std::uint32_t next = 1;
    for (std::size_t i = 0; i < first.ids.size(); ++i) {
      ASSERT_LE(first.ids[i], next);
      if (first.ids[i] == next) ++next;
      ++areas[first.ids[i]];
      ASSERT_EQ(first.depths_m[i] > 0, first.ids[i] != 0);
    }
    EXPECT_EQ(areas, first.areas);
  });
}

TEST(GraphSegmenter, SplitsAtAValleyButNotAtARidge) {
  const Intrinsics K{260, 260, 79.5F, 59.5F, 160, 120};
  test::onEachDevice([&](ComputeContext& compute) {
    for (const bool convex : {true, false}) {
      const reference::RenderedFaces faces =
          reference::render(reference::wedge(convex, convex ? 0.25 : 0.8), K);
      const SegmentMap map = segment(compute, upload(compute, {K, faces.vertices, faces.normals}), {});
      ASSERT_EQ(map.count(), convex ? 1 : 2);
      for (std::size_t i = 0; i < map.ids.size(); ++i) {
        ASSERT_EQ(map.ids[i], convex ? 1U : static_cast<std::uint32_t>(faces.faces[i] + 1));
      }
    }
  });
}

TEST(GraphSegmenter, FindsNoSegments_InAnEmptyFrame) {
  test::onEachDevice([](ComputeContext& compute) {
    const Scene scene{{100, 100, 8, 6, 17, 13},
                      std::vector<cl_float4>(221, cl_float4{{0, 0, 0, 0}}),
                      std::vector<cl_float4>(221, cl_float4{{0, 0, 0, 0}})};
    const SegmentMap map = segment(compute, upload(compute, scene), {});
    EXPECT_EQ(map.count(), 0);
    EXPECT_EQ(map.areas, std::vector<int>{221});
    EXPECT_EQ(map.ids, std::vector<std::uint32_t>(221, 0));
    EXPECT_EQ(segment(compute, SurfaceMaps{}, {}).count(), 0);
  });
}

}  // namespace
}  // namespace scantrove
