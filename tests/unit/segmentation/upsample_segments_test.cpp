#include "core/segmentation/upsample_segments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "core/capture/intrinsics.h"

namespace scantrove {
namespace {

TEST(DepthUpsampler, TakesTheNearestPixel_WithoutDepthReadings) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 1; i <= 35; ++i) ids.push_back(i);
  const std::vector<float> depths_m(35, 1.0F);
  const std::vector<std::uint16_t> no_depth(16 * 9, 0);
  const std::vector<std::uint32_t> larger =
      DepthUpsampler(depths_m, 7, 5, {16, 9, no_depth, 0.001F}).apply(ids);
  const Intrinsics K{1, 1, 0, 0, 16, 9};
  const Intrinsics small = K.resizedTo(7, 5);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 16; ++u) {
      const int x = static_cast<int>(std::floor(static_cast<float>(u) * small.fx + small.cx + 0.5F));
      const int y = static_cast<int>(std::floor(static_cast<float>(v) * small.fy + small.cy + 0.5F));
      EXPECT_EQ(larger[static_cast<std::size_t>(v * 16 + u)], ids[static_cast<std::size_t>(y * 7 + x)]);
    }
  }
}

TEST(DepthUpsampler, FollowsOutlinesOfTheDepthImage) {
  // A near surface (1) left of column 5 of the large image, a far one (2) right of it. The small map has no
  // ids in the middle.
  const int width = 4, height = 3;
  std::vector<std::uint32_t> ids;
  std::vector<float> depths_m;
  for (int y = 0; y < height; ++y) {
    for (const auto& [id, depth_m] : std::initializer_list<std::pair<std::uint32_t, float>>{
             {1, 0.8F}, {0, 0.0F}, {0, 0.0F}, {2, 0.95F}}) {
      ids.push_back(id);
      depths_m.push_back(depth_m);
    }
  }
  std::vector<std::uint16_t> depth;
  for (int v = 0; v < 6; ++v) {
    for (int u = 0; u < 8; ++u) depth.push_back(u < 5 ? 800 : 950);
  }
  depth[3] = 0;    // no reading: the id of the nearest pixel, here none
  depth[6] = 0;    // no reading: the id of the nearest pixel, here 2
  depth[1] = 500;  // a surface missing in the map
  const std::vector<std::uint32_t> result =
      DepthUpsampler(depths_m, width, height, {8, 6, depth, 0.001F}).apply(ids);
  EXPECT_EQ(result[3], 0U);
  EXPECT_EQ(result[6], 2U);
  EXPECT_EQ(result[1], 0U);
  for (std::size_t v = 1; v < 6; ++v) {
    for (std::size_t u = 0; u < 8; ++u) EXPECT_EQ(result[v * 8 + u], u < 5 ? 1U : 2U) << u << ", " << v;
  }
}

/// The definition: an exhaustive search by rows; of equal costs the first wins.
std::vector<std::uint32_t> upsampleByTheDefinition(const std::vector<std::uint32_t>& ids,
                                                   const std::vector<float>& depths_m, int width, int height,
                                                   const DepthGuide& guide) {
  const float per_x = static_cast<float>(width) / static_cast<float>(guide.width);
  const float per_y = static_cast<float>(height) / static_cast<float>(guide.height);
  std::vector<std::uint32_t> result;
  for (int v = 0; v < guide.height; ++v) {
    for (int u = 0; u < guide.width; ++u) {
      const int x0 = (2 * u + 1) * width / (2 * guide.width), y0 = (2 * v + 1) * height / (2 * guide.height);
      const float x_exact = (static_cast<float>(u) + 0.5F) * per_x - 0.5F;
      const float y_exact = (static_cast<float>(v) + 0.5F) * per_y - 0.5F;
      const float z = static_cast<float>(guide.depth[static_cast<std::size_t>(v * guide.width + u)]) *
                      guide.meters_per_unit;
      std::uint32_t id = z > 0 ? 0 : ids[static_cast<std::size_t>(y0 * width + x0)];
      float best = 1000;
      for (int y = std::max(y0 - 3, 0); z > 0 && y <= std::min(y0 + 3, height - 1); ++y) {
        for (int x = std::max(x0 - 3, 0); x <= std::min(x0 + 3, width - 1); ++x) {
          const auto source = static_cast<std::size_t>(y * width + x);
          const float step_m = std::abs(depths_m[source] - z) / std::max(1.0F, z * z);
          const float cost =
              std::hypot(static_cast<float>(x) - x_exact, static_cast<float>(y) - y_exact) + step_m / 0.004F;
          if (ids[source] == 0 || !(step_m < 0.02F) || !(cost < best)) continue;
          best = cost;
          id = ids[source];
        }
      }
      result.push_back(id);
    }
  }
  return result;
}

TEST(DepthUpsampler, EqualsTheDefinition_WithStepsHolesAndNoise) {
  std::mt19937 random(11);
  const int width = 40, height = 30;
  std::vector<std::uint32_t> ids;
  std::vector<float> depths_m;
  for (int i = 0; i < width * height; ++i) {
    const bool is_near = (i % width / 7 + i / width / 5) % 2 == 0;
    const bool is_hole = random() % 5 == 0;
    ids.push_back(is_hole || random() % 6 == 0 ? 0 : 1 + random() % 4);  // a part of the surface has no id
    depths_m.push_back(is_hole ? 0 : (is_near ? 0.9F : 1.3F) + 1e-4F * static_cast<float>(random() % 100));
  }
  for (const auto& [large_width, large_height] : {std::pair(80, 60), std::pair(97, 61), std::pair(33, 20)}) {
    std::vector<std::uint16_t> depth;
    for (int i = 0; i < large_width * large_height; ++i) {
      const bool is_near =
          (i % large_width * width / large_width / 7 + i / large_width * height / large_height / 5) % 2 == 0;
      // Coarse steps give equal costs, so the order matters.
      depth.push_back(random() % 9 == 0 ? 0
                                        : static_cast<std::uint16_t>((is_near ? 900 : 1300) + random() % 10));
    }
    const DepthGuide guide{large_width, large_height, depth, 0.001F};
    EXPECT_EQ(DepthUpsampler(depths_m, width, height, guide).apply(ids),
              upsampleByTheDefinition(ids, depths_m, width, height, guide))
        << large_width << " x " << large_height;
  }
}

TEST(DepthUpsampler, GivesUnlabeledPixels_WhenTheMapIsEmpty) {
  const std::vector<std::uint16_t> depth(12, 1000);
  EXPECT_EQ(DepthUpsampler({}, 0, 0, {4, 3, depth, 0.001F}).apply(std::vector<std::uint32_t>()),
            std::vector<std::uint32_t>(12, 0));
}

}  // namespace
}  // namespace scantrove
