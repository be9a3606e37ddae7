#include "ui/scene/brick_shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace scantrove {
namespace {

constexpr float kSide_m = 0.005F;
constexpr FragmentId kMug{3}, kBoard{4};

CloudBrick::Point pointAt(int x, int y, int z) {
  const auto center = [](int voxel) { return (static_cast<float>(voxel) + 0.5F) * kSide_m; };
  CloudBrick::Point point{center(x), center(y), center(z), kBoard};
  point.color = PackedColor::of(120, 100, 80);
  point.normal = PackedNormal::of(Eigen::Vector3f::UnitZ());
  return point;
}

/// A level surface through brick (-1, 0, 2): a layer of voxels on it, and a row above at its fringe.
std::vector<CloudBrick::Point> plane() {
  std::vector<CloudBrick::Point> points;
  for (int y = 0; y < 8; ++y) {
    for (int x = -8; x < 0; ++x) points.push_back(pointAt(x, y, 19));
  }
  for (int x = -8; x < 0; ++x) {
    points.push_back(pointAt(x, 0, 20));
    points.back().height = 55;
  }
  return points;
}

TEST(HasSameAppearance, IsTrue_ForEqualPoints) { EXPECT_TRUE(hasSameAppearance(plane(), plane(), kSide_m)); }

TEST(HasSameAppearance, IgnoresTheOrderOfPoints) {
  std::vector<CloudBrick::Point> turned = plane();
  std::ranges::reverse(turned);
  EXPECT_TRUE(hasSameAppearance(plane(), turned, kSide_m));
}

TEST(HasSameAppearance, IsFalse_WhenOneFragmentDiffers) {
  std::vector<CloudBrick::Point> relabeled = plane();
  relabeled[20].fragment = kMug;
  EXPECT_FALSE(hasSameAppearance(plane(), relabeled, kSide_m));
}

TEST(HasSameAppearance, IgnoresAddedAndRemovedPoints_OnlyAtTheFringe) {
  std::vector<CloudBrick::Point> fewer = plane();
  fewer.erase(fewer.begin() + 10);
  EXPECT_FALSE(hasSameAppearance(plane(), fewer, kSide_m)) << "a hole";
  EXPECT_FALSE(hasSameAppearance(fewer, plane(), kSide_m)) << "a closed hole";
  std::vector<CloudBrick::Point> without_fringe = plane();
  without_fringe.resize(64);
  EXPECT_TRUE(hasSameAppearance(plane(), without_fringe, kSide_m));
  EXPECT_TRUE(hasSameAppearance(without_fringe, plane(), kSide_m));
  EXPECT_FALSE(hasSameAppearance({}, plane(), kSide_m));
}

TEST(HasSameAppearance, CountsPoints_BetweenTwoVoxelLayers) {
  std::vector<CloudBrick::Point> between = plane();
  for (CloudBrick::Point& point : between) point.height = 50;
  EXPECT_FALSE(hasSameAppearance({}, between, kSide_m));
  std::vector<CloudBrick::Point> fewer = between;
  fewer.pop_back();
  EXPECT_FALSE(hasSameAppearance(fewer, between, kSide_m));
}

TEST(HasSameAppearance, IsFalse_WhenManyColorsOrHeightsDiffer) {
  const auto changed = [](std::size_t count, auto&& change) {
    std::vector<CloudBrick::Point> points = plane();
    for (std::size_t i = 0; i < count; ++i) change(points[i]);
    return !hasSameAppearance(plane(), points, kSide_m);
  };
  const auto redden = [](CloudBrick::Point& point) { point.color.rgb[0] += 40; };
  const auto redden_a_little = [](CloudBrick::Point& point) { point.color.rgb[0] += 5; };
  const auto lower = [](CloudBrick::Point& point) { point.height = 30; };
  const auto hide_color = [](CloudBrick::Point& point) { point.color = {}; };
  EXPECT_FALSE(changed(5, redden));
  EXPECT_TRUE(changed(20, redden));
  EXPECT_FALSE(changed(64, redden_a_little));
  EXPECT_TRUE(changed(20, lower));
  EXPECT_FALSE(changed(64, hide_color)) << "it takes the colour of its neighbours";
}

TEST(SmoothNormals, ReducesNoise_OnAPlane) {
  std::vector<CloudBrick::Point> points = plane();
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.15F);
  for (CloudBrick::Point& point : points)
    point.normal = PackedNormal::of(Eigen::Vector3f(noise(random), noise(random), 1));
  const auto meanTilt = [](auto begin, auto end, const auto& normalOf) {
    float sum = 0;
    for (auto it = begin; it != end; ++it) sum += std::acos(std::min(1.0F, normalOf(*it).unpacked().z()));
    return sum / static_cast<float>(end - begin);
  };
  constexpr std::size_t kDrawn = 30;
  const std::vector<PackedNormal> smooth = smoothNormals(points, kDrawn, kSide_m);
  ASSERT_EQ(smooth.size(), kDrawn);
  const float before = meanTilt(points.begin(), points.begin() + kDrawn,
                                [](const CloudBrick::Point& point) { return point.normal; });
  const float after = meanTilt(smooth.begin(), smooth.end(), [](PackedNormal normal) { return normal; });
  // The mean of nine independent normals (six at a border) has a third (0.4) of their error.
  EXPECT_LT(after, 0.5F * before);
}

TEST(SmoothNormals, KeepsNormals_AcrossAnEdge) {
  std::vector<CloudBrick::Point> points = plane();
  points.resize(64);
  for (int y = 0; y < 8; ++y) {
    points.push_back(pointAt(-1, y, 20));
    points.back().normal = PackedNormal::of(Eigen::Vector3f::UnitX());
  }
  const std::vector<PackedNormal> smooth = smoothNormals(points, points.size(), kSide_m);
  EXPECT_GT(smooth.front().unpacked().z(), 0.999F);
  EXPECT_GT(smooth.back().unpacked().x(), 0.999F);
}

}  // namespace
}  // namespace scantrove
