// Splits of a flat surface along its colours. Expected parts come from the layout of the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "core/editing/stroke_surroundings.h"
#include "core/editing/surface_colors.h"
#include "core/editing/surface_split.h"

namespace scantrove::test {
namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kWood{190, 150, 100}, kPaper{225, 225, 220}, kPurple{130, 75, 140};
constexpr int kWidth = 120, kDepth = 80;

/// The page on the table.
bool isOnPage(int x, int y) { return x >= 40 && x < 80 && y >= 25 && y < 55; }
/// Voxels at the outline of the page, which may go either way.
bool isAtOutline(int x, int y) {
  const bool is_near = x >= 38 && x < 82 && y >= 23 && y < 57,
             is_inside = x >= 42 && x < 78 && y >= 27 && y < 53;
  return is_near && !is_inside;
}

/// A flat table of two layers of voxels; `colorOf` colours both.
SurfaceGraph table(const std::function<Rgb(int x, int y)>& colorOf) {
  std::vector<SurfaceVoxel> voxels;
  for (int x = 0; x < kWidth; ++x) {
    for (int y = 0; y < kDepth; ++y) {
      const Rgb rgb = colorOf(x, y);
      for (int z = -1; z <= 0; ++z) voxels.push_back({{x, y, z}, {0, 0, 1}, FragmentId{1}, rgb});
    }
  }
  return SurfaceGraph::of(std::move(voxels));
}

Rgb page(int x, int y) { return isOnPage(x, y) ? kPaper : kWood; }

/// The colour in `light` times the light, by the transfer function of sRGB.
Rgb shaded(const Rgb& color, double light) {
  Rgb result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double linear = light * std::pow((color[i] / 255.0 + 0.055) / 1.055, 2.4);
    result[i] = static_cast<std::uint8_t>(std::lround(255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055)));
  }
  return result;
}

/// The voxels of a stroke of both layers, 3 voxels wide, along x at `y`.
std::vector<std::uint32_t> stroke(const SurfaceGraph& graph, int from_x, int to_x, int y) {
  std::vector<std::uint32_t> voxels;
  for (std::uint32_t i = 0; i < graph.voxels.size(); ++i) {
    const Eigen::Vector3i& at = graph.voxels[i].voxel;
    if (at.x() >= from_x && at.x() <= to_x && std::abs(at.y() - y) <= 1) voxels.push_back(i);
  }
  return voxels;
}

std::vector<std::uint8_t> splitAround(const SurfaceGraph& graph, const std::vector<std::uint32_t>& here) {
  const std::vector<std::uint32_t> there = surroundingsOf(graph, here);
  EXPECT_FALSE(there.empty());
  return there.empty() ? std::vector<std::uint8_t>(graph.voxels.size(), 0) : splitSurface(graph, here, there);
}

/// Voxels, away from the outline, that lie on the other side than the page (0) or the table (1) does.
int wrongSides(const SurfaceGraph& graph, const std::vector<std::uint8_t>& side) {
  int wrong = 0;
  for (std::size_t i = 0; i < graph.voxels.size(); ++i) {
    const Eigen::Vector3i& at = graph.voxels[i].voxel;
    if (!isAtOutline(at.x(), at.y())) wrong += (side[i] == 0) != isOnPage(at.x(), at.y()) ? 1 : 0;
  }
  return wrong;
}

TEST(TintDifference, CountsShadowAQuarter_AndChromaInFull) {
  const Eigen::Vector3f lit(100, 20, 20);
  EXPECT_NEAR(tintDifference(lit, 0.8F * lit), 0.25F * 0.2F * lit.norm(), 1e-3F);
  // Perpendicular to both tints together: |(0, 10, -10)|.
  EXPECT_NEAR(tintDifference({100, 5, -5}, {100, -5, 5}), std::sqrt(200.0F), 1e-3F);
  EXPECT_EQ(tintDifference(lit, lit), 0);
}

TEST(SurfaceColors, ColorStepsStandAtTheOutline) {
  const SurfaceGraph graph = table(page);
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    const Eigen::Vector3i &a = graph.voxels[edge.a].voxel, &b = graph.voxels[edge.b].voxel;
    if (isOnPage(a.x(), a.y()) != isOnPage(b.x(), b.y())) {
      EXPECT_GT(edge.color_step, 5) << a.transpose();
    } else if (!isAtOutline(a.x(), a.y())) {
      EXPECT_LT(edge.color_step, 0.1F) << a.transpose();
    }
  }
}

TEST(SurfaceColors, FillsVoxelsThatWereNeverSeenInColor) {
  std::vector<SurfaceVoxel> voxels;
  for (int x = 0; x < 5; ++x) {
    voxels.push_back({{x, 0, 0}, {0, 0, 1}, FragmentId{1}, kWood});
    if (x == 2) voxels.back().rgb.reset();
  }
  const SurfaceGraph graph = SurfaceGraph::of(std::move(voxels));
  EXPECT_LT((graph.tints[2] - graph.tints[0]).norm(), 0.01F);
  EXPECT_EQ(graph.edges[1].color_step, 0);
}

TEST(ColorSplit, TwoStrokesDivideAtTheOutline_HoweverNearEachLies) {
  const SurfaceGraph graph = table(page);
  // Midway between both strokes would be x = 20.
  const auto side = splitSurface(graph, stroke(graph, 44, 48, 40), stroke(graph, 2, 4, 10));
  EXPECT_EQ(wrongSides(graph, side), 0);
}

TEST(ColorSplit, OneStrokeOrClickTakesThePage) {
  const SurfaceGraph graph = table(page);
  EXPECT_EQ(wrongSides(graph, splitAround(graph, stroke(graph, 46, 74, 40))), 0);
  EXPECT_EQ(wrongSides(graph, splitAround(graph, stroke(graph, 60, 61, 40))), 0) << "a click";
}

TEST(ColorSplit, OneStrokeTakesThePage_WhenAShadowLiesAcross) {
  // Half the light left of x = 60, with a penumbra of 4 voxels; the stroke covers only what is lit.
  const SurfaceGraph graph = table(
      [](int x, int y) { return shaded(page(x, y), 0.5 + 0.5 * std::clamp((x - 58) / 4.0, 0.0, 1.0)); });
  EXPECT_EQ(wrongSides(graph, splitAround(graph, stroke(graph, 64, 76, 40))), 0);
  EXPECT_EQ(wrongSides(graph, splitSurface(graph, stroke(graph, 64, 76, 40), stroke(graph, 90, 110, 10))), 0);
}

TEST(ColorSplit, GrainCountsLittle) {
  std::mt19937 random(7);
  std::normal_distribution<double> grain(0, 9);
  const SurfaceGraph graph = table([&](int x, int y) {
    Rgb rgb = page(x, y);
    for (std::uint8_t& value : rgb)
      value = static_cast<std::uint8_t>(std::clamp(std::lround(value + grain(random)), 0L, 255L));
    return rgb;
  });
  EXPECT_LE(wrongSides(graph, splitAround(graph, stroke(graph, 46, 74, 40))), 20);
  EXPECT_LE(wrongSides(graph, splitSurface(graph, stroke(graph, 44, 48, 40), stroke(graph, 2, 4, 10))), 20);
}

TEST(ColorSplit, PrintStaysWithItsPage) {
  // Dark bars of text, which the stroke does not cover.
  const SurfaceGraph graph = table([](int x, int y) {
    const bool is_text = x >= 48 && x < 72 && (y / 3) % 3 == 0 && y >= 29 && y < 51 && (y < 38 || y > 42);
    return is_text ? Rgb{60, 60, 60} : page(x, y);
  });
  EXPECT_EQ(wrongSides(graph, splitAround(graph, stroke(graph, 46, 74, 40))), 0);
}

TEST(ColorSplit, NeighboringPagesStayApart) {
  // A second page of another colour touches the first.
  const SurfaceGraph graph =
      table([](int x, int y) { return x >= 80 && x < 100 && y >= 25 && y < 55 ? kPurple : page(x, y); });
  EXPECT_EQ(wrongSides(graph, splitAround(graph, stroke(graph, 46, 74, 40))), 0);
}

TEST(ColorSplit, StrokeOnTheTableLeavesThePageOut) {
  const SurfaceGraph graph = table(page);
  std::vector<std::uint8_t> side = splitAround(graph, stroke(graph, 10, 100, 10));
  for (std::uint8_t& of_voxel : side) of_voxel = of_voxel == 0 ? 1 : 0;
  EXPECT_EQ(wrongSides(graph, side), 0);
}

TEST(ColorSplit, FindsNoSurroundings_WhenNothingDiffers) {
  const SurfaceGraph plain = table([](int, int) { return kWood; });
  EXPECT_TRUE(surroundingsOf(plain, stroke(plain, 46, 74, 40)).empty());
  // A chroma that changes slowly, by 25 across the table, is no edge.
  const SurfaceGraph slow = table([](int x, int) {
    return Rgb{190, 150, static_cast<std::uint8_t>(100 + x / 4)};
  });
  EXPECT_TRUE(surroundingsOf(slow, stroke(slow, 2, 10, 40)).empty());
  const SurfaceGraph uncolored = SurfaceGraph::of({{{0, 0, 0}, {0, 0, 1}, FragmentId{1}}});
  EXPECT_TRUE(surroundingsOf(uncolored, std::vector<std::uint32_t>{0}).empty());
}

/// A valley: two planes that meet at x = 30, in one colour or in none.
SurfaceGraph valley(const std::optional<Rgb>& color) {
  std::vector<SurfaceVoxel> voxels;
  for (int x = 0; x < 60; ++x) {
    for (int y = 0; y < 40; ++y) {
      const float lean = std::clamp((30 - static_cast<float>(x)) / 2, -1.0F, 1.0F) * 0.7F;
      voxels.push_back({{x, y, std::abs(x - 30)}, {std::sin(lean), 0, std::cos(lean)}, FragmentId{1}, color});
    }
  }
  return SurfaceGraph::of(std::move(voxels));
}

TEST(ColorSplit, FollowsAFoldAsWithoutColors_WhenAllHasOneColor) {
  std::vector<std::vector<std::uint8_t>> sides;
  for (const std::optional<Rgb>& color : {std::optional<Rgb>(), std::optional<Rgb>(kWood)}) {
    const SurfaceGraph graph = valley(color);
    sides.push_back(splitSurface(graph, stroke(graph, 20, 21, 20), stroke(graph, 57, 58, 20)));
    for (std::size_t i = 0; i < graph.voxels.size(); ++i) {
      const int x = graph.voxels[i].voxel.x();
      if (std::abs(x - 30) <= 3) continue;
      EXPECT_EQ(sides.back()[i], x > 30 ? 1 : 0) << x;
    }
  }
  EXPECT_EQ(sides[0], sides[1]);
}

TEST(ColorSplit, SegmentationFollowsColors_OnlyWhenAsked) {
  const SurfaceGraph graph = table(page);
  const auto by_folds = segmentSurface(graph, 1, 50, SurfaceCues::folds);
  EXPECT_EQ(std::ranges::max(by_folds), 0U);
  const auto parts = segmentSurface(graph, 1, 50, SurfaceCues::folds_and_colors);
  EXPECT_EQ(std::ranges::max(parts), 1U);
  std::vector<std::uint8_t> side(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) side[i] = parts[i] == 0 ? 1 : 0;
  EXPECT_EQ(wrongSides(graph, side), 0) << "the table holds the first voxel";
}

TEST(SurfaceGraph, HasTheSameEdges_WhateverTheOrderOfItsVoxels) {
  SurfaceGraph graph = table(page);
  std::vector<SurfaceVoxel> voxels = graph.voxels;
  std::ranges::shuffle(voxels, std::mt19937(3));
  const SurfaceGraph shuffled = SurfaceGraph::of(std::move(voxels));
  ASSERT_EQ(shuffled.edges.size(), graph.edges.size());
  for (std::uint32_t i = 0; i < shuffled.voxels.size(); ++i) {
    for (const SurfaceGraph::Neighbor& next : shuffled.neighborsOf(i)) {
      const Eigen::Vector3i step = shuffled.voxels[next.voxel].voxel - shuffled.voxels[i].voxel;
      EXPECT_EQ(step.cwiseAbs().maxCoeff(), 1);
      const SurfaceGraph::Edge& edge = shuffled.edges[next.edge];
      EXPECT_EQ(std::minmax(edge.a, edge.b), std::minmax(i, next.voxel));
    }
  }
  EXPECT_TRUE(std::ranges::is_sorted(
      shuffled.edges, {}, [](const SurfaceGraph::Edge& edge) { return std::pair(edge.a, edge.b); }));
}

}  // namespace
}  // namespace scantrove::test
