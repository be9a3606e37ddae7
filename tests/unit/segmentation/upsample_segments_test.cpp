#include "core/segmentation/upsample_segments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/capture/intrinsics.h"

namespace scantrove {
namespace {

TEST(UpsampleByDepth, WithoutReadingsTakesThePixelThatTheSmallCameraSees) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 1; i <= 35; ++i) ids.push_back(i);
  const std::vector<std::uint16_t> no_depth(16 * 9, 0);
  const std::vector<std::uint32_t> larger =
      upsampleByDepth(ids, std::vector<float>(35, 1.0F), 7, 5, {16, 9, no_depth, 0.001F});
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

TEST(UpsampleByDepth, OutlinesFollowTheDepthImage) {
  // A near surface (1) left of column 5 of the large image, a far one (2) right of it; the small map has lost
  // its middle.
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
  depth[3] = 0;    // no reading: the nearest pixel's id, which is none
  depth[6] = 0;    // the same where the nearest is labelled
  depth[1] = 500;  // a surface that the map does not have
  const std::vector<std::uint32_t> result =
      upsampleByDepth(ids, depths_m, width, height, {8, 6, depth, 0.001F});
  EXPECT_EQ(result[3], 0U);
  EXPECT_EQ(result[6], 2U);
  EXPECT_EQ(result[1], 0U);
  for (std::size_t v = 1; v < 6; ++v) {
    for (std::size_t u = 0; u < 8; ++u) EXPECT_EQ(result[v * 8 + u], u < 5 ? 1U : 2U) << u << ", " << v;
  }
}

TEST(UpsampleByDepth, EmptyMapsGiveUnlabelledPixels) {
  const std::vector<std::uint16_t> depth(12, 1000);
  EXPECT_EQ(upsampleByDepth({}, {}, 0, 0, {4, 3, depth, 0.001F}), std::vector<std::uint32_t>(12, 0));
}

}  // namespace
}  // namespace scantrove
