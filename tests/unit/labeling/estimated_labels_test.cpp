#include "core/labeling/estimated_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/poses.h"

namespace scantrove {
namespace {

constexpr float kVoxel_m = 0.005F, kCell_m = 0.01F;
constexpr Intrinsics kEstimateCamera{60, 60, 31.5F, 23.5F, 64, 48};
constexpr FragmentId kGlass{7}, kBottle{9};

/// A view from `T_world_camera` without surface.
RenderedView emptyViewFrom(const Eigen::Isometry3d& T_world_camera = Eigen::Isometry3d::Identity()) {
  const auto pixels = static_cast<std::size_t>(kEstimateCamera.pixels());
  RenderedView view;
  view.K = kEstimateCamera;
  view.T_world_camera = T_world_camera;
  view.vertices_world.assign(pixels, Eigen::Vector4f::Zero());
  view.fragments.assign(pixels, FragmentId{});
  return view;
}

/// The world point that a pixel of the view sees at that depth.
Eigen::Vector3d pointSeenAt(const RenderedView& view, int u, int v, double z_m) {
  const Intrinsics& K = view.K;
  return view.T_world_camera * Eigen::Vector3d((u - static_cast<double>(K.cx)) / K.fx * z_m,
                                               (v - static_cast<double>(K.cy)) / K.fy * z_m, z_m);
}

/// A wall `z_m` ahead that the depth image shows.
RenderedView measuredWall(float z_m) {
  RenderedView view = emptyViewFrom();
  for (int v = 0; v < view.K.height; ++v) {
    for (int u = 0; u < view.K.width; ++u)
      view.vertices_world[view.K.indexOf(u, v)] = pointSeenAt(view, u, v, z_m).cast<float>().homogeneous();
  }
  return view;
}

/// Writes the fragment for one estimated pixel, as `times` frames do.
void writeEstimate(EstimatedLabels& labels, RenderedView view, int u, int v, double z_m, FragmentId fragment,
                   int times = 1) {
  const std::size_t pixel = view.K.indexOf(u, v);
  view.is_estimated.assign(view.vertices_world.size(), 0);
  view.is_estimated[pixel] = 1;
  view.vertices_world[pixel] = pointSeenAt(view, u, v, z_m).cast<float>().homogeneous();
  std::vector<FragmentId> fragments(view.vertices_world.size());
  fragments[pixel] = fragment;
  // The other pixels are estimated, too, but of no fragment, so that their cells stay as they are.
  const std::vector<std::uint8_t> estimated(fragments.size(), 1);
  for (int i = 0; i < times; ++i) labels.update(view, estimated, fragments);
}

void observe(EstimatedLabels& labels, const RenderedView& measured) {
  labels.update(measured, {}, std::vector<FragmentId>(measured.vertices_world.size()));
}

int cellsOf(const EstimatedLabels& labels, FragmentId fragment) {
  const std::vector<int>& cells = labels.cellsOfFragments();
  return fragment.value < cells.size() ? cells[fragment.value] : 0;
}

FragmentId projectedAt(const EstimatedLabels& labels, int u, int v, RenderedView view = emptyViewFrom()) {
  labels.project(view);
  return view.fragments[view.K.indexOf(u, v)];
}

TEST(EstimatedLabels, WrittenPixelProjectsBackToItself) {
  for (const auto& [u, v] : {std::pair{20, 15}, std::pair{0, 0}, std::pair{63, 47}, std::pair{32, 24}}) {
    EstimatedLabels labels(kVoxel_m);
    EXPECT_TRUE(labels.isEmpty());
    writeEstimate(labels, emptyViewFrom(), u, v, 1, kGlass);
    EXPECT_FALSE(labels.isEmpty());
    RenderedView view = emptyViewFrom();
    labels.project(view);
    ASSERT_EQ(view.is_estimated.size(), view.vertices_world.size());
    const std::size_t pixel = view.K.indexOf(u, v);
    EXPECT_EQ(view.is_estimated[pixel], 1);
    EXPECT_EQ(view.fragments[pixel], kGlass);
    const Eigen::Vector3d vertex = view.vertices_world[pixel].head<3>().cast<double>();
    EXPECT_EQ(view.vertices_world[pixel].w(), 1);
    EXPECT_LE((vertex - pointSeenAt(view, u, v, 1)).norm(), 0.5 * std::sqrt(3.0) * kCell_m + 1e-5);
    for (int y = 0; y < view.K.height; ++y) {
      for (int x = 0; x < view.K.width; ++x) {
        const bool is_near = std::abs(x - u) <= 2 && std::abs(y - v) <= 2;
        const std::size_t other = view.K.indexOf(x, y);
        if (is_near) continue;
        ASSERT_EQ(view.is_estimated[other], 0) << x << ", " << y;
        ASSERT_FALSE(view.fragments[other]);
      }
    }
  }
}

TEST(EstimatedLabels, MeasuredPixelKeepsItsSurface_WhenCellsProjectThere) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  for (const float z_m : {0.5F, 2.0F}) {
    RenderedView view = measuredWall(z_m);
    const std::vector<Eigen::Vector4f> before = view.vertices_world;
    labels.project(view);
    const std::size_t pixel = view.K.indexOf(20, 15);
    EXPECT_TRUE(view.vertices_world[pixel] == before[pixel]);
    EXPECT_FALSE(view.fragments[pixel]);
    EXPECT_EQ(view.is_estimated[pixel], 0);
  }
}

TEST(EstimatedLabels, MeasuredSurfaceRemovesCells_AtItsPlaceOrBehindIt) {
  for (const float z_m : {0.98F, 1.0F, 1.02F, 1.5F}) {
    EstimatedLabels labels(kVoxel_m);
    writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass, 20);
    ASSERT_EQ(cellsOf(labels, kGlass), 1);
    observe(labels, measuredWall(z_m));
    EXPECT_TRUE(labels.isEmpty()) << z_m;
    EXPECT_EQ(cellsOf(labels, kGlass), 0) << z_m;
    EXPECT_FALSE(projectedAt(labels, 20, 15)) << z_m;
  }
}

TEST(EstimatedLabels, CellsStay_WhenAnOccluderHidesThem) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  for (int i = 0; i < 20; ++i) observe(labels, measuredWall(0.5F));
  EXPECT_EQ(cellsOf(labels, kGlass), 1);
  EXPECT_EQ(projectedAt(labels, 20, 15), kGlass);
}

TEST(EstimatedLabels, CellsStay_WhenNothingIsMeasuredThere) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  for (int i = 0; i < 20; ++i) observe(labels, emptyViewFrom());
  EXPECT_EQ(projectedAt(labels, 20, 15), kGlass);
}

TEST(EstimatedLabels, AnotherFragmentTakesOver_AfterAsManyFrames) {
  for (const int frames : {1, 3, 5}) {
    EstimatedLabels labels(kVoxel_m);
    writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass, frames);
    writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kBottle, frames - 1);
    EXPECT_EQ(projectedAt(labels, 20, 15), kGlass) << frames;
    EXPECT_EQ(cellsOf(labels, kGlass), 1);
    EXPECT_EQ(cellsOf(labels, kBottle), 0);
    writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kBottle);
    EXPECT_EQ(projectedAt(labels, 20, 15), kBottle) << frames;
    EXPECT_EQ(cellsOf(labels, kGlass), 0);
    EXPECT_EQ(cellsOf(labels, kBottle), 1);
  }
}

TEST(EstimatedLabels, AnotherFragmentTakesOverSoon_HoweverManyFramesAgreedBefore) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass, 300);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kBottle, 3);
  EXPECT_EQ(projectedAt(labels, 20, 15), kGlass);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kBottle, 7);
  EXPECT_EQ(projectedAt(labels, 20, 15), kBottle);
}

/// A frame with supports sees the place of the cell at (20, 15), which it takes for nothing.
void seeNothing(EstimatedLabels& labels) {
  RenderedView view = emptyViewFrom();
  labels.project(view);
  const std::vector<std::uint8_t> estimated(view.vertices_world.size(), 0);
  labels.update(view, estimated, view.fragments);
}

TEST(EstimatedLabels, CellsGo_WhenAsManyFramesEstimateNothingThere) {
  for (const int frames : {1, 3, 8}) {
    EstimatedLabels labels(kVoxel_m);
    writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass, frames);
    for (int i = 1; i < frames; ++i) seeNothing(labels);
    EXPECT_EQ(cellsOf(labels, kGlass), 1) << frames;
    seeNothing(labels);
    EXPECT_TRUE(labels.isEmpty()) << frames << ": seeing a cell does not confirm it";
  }
}

TEST(EstimatedLabels, HiddenCellsStay_WhenFramesEstimateNothingThere) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  const RenderedView wall = measuredWall(0.5F);
  const std::vector<std::uint8_t> estimated(wall.vertices_world.size(), 0);
  for (int i = 0; i < 20; ++i) labels.update(wall, estimated, wall.fragments);
  EXPECT_EQ(cellsOf(labels, kGlass), 1);
}

TEST(EstimatedLabels, CountsAreCellsOfEachFragment) {
  EstimatedLabels labels(kVoxel_m);
  for (const int u : {10, 20, 30}) writeEstimate(labels, emptyViewFrom(), u, 15, 1, kGlass);
  for (const int u : {40, 50}) writeEstimate(labels, emptyViewFrom(), u, 15, 1, kBottle, 2);
  writeEstimate(labels, emptyViewFrom(), 10, 15, 1, kGlass, 5);  // again the same cell
  EXPECT_EQ(cellsOf(labels, kGlass), 3);
  EXPECT_EQ(cellsOf(labels, kBottle), 2);
}

TEST(EstimatedLabels, NearestCellIsSeen_WhenSeveralLieOnARay) {
  const Eigen::Isometry3d ahead = test::pose(0, 0, 0, 0, 0, 0.5);
  for (const bool near_first : {false, true}) {
    EstimatedLabels labels(kVoxel_m);
    if (near_first) writeEstimate(labels, emptyViewFrom(), 32, 24, 1, kGlass);
    writeEstimate(labels, emptyViewFrom(ahead), 32, 24, 1, kBottle);  // 1.5 m from the origin
    if (!near_first) writeEstimate(labels, emptyViewFrom(), 32, 24, 1, kGlass);
    ASSERT_EQ(cellsOf(labels, kGlass) + cellsOf(labels, kBottle), 2);
    EXPECT_EQ(projectedAt(labels, 32, 24), kGlass) << near_first;
  }
}

TEST(EstimatedLabels, AnotherPoseSeesCells_WhereTheyProject) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1.2, kGlass);
  const Eigen::Vector3d point = pointSeenAt(emptyViewFrom(), 20, 15, 1.2);
  for (const Eigen::Isometry3d& pose :
       {test::pose(0, 0, 0, -0.3, 0, 0), test::pose(3, -12, 20, 0.1, 0.2, -0.3),
        test::pose(0, 180, 0, 0, 0, 2.5)}) {
    RenderedView view = emptyViewFrom(pose);
    labels.project(view);
    const Eigen::Vector3d p = pose.inverse() * point;
    ASSERT_GT(p.z(), 0);
    const auto u = static_cast<int>(std::lround(60 * p.x() / p.z() + 31.5));
    const auto v = static_cast<int>(std::lround(60 * p.y() / p.z() + 23.5));
    ASSERT_TRUE(view.K.isInside(u, v)) << u << ", " << v;
    const std::size_t pixel = view.K.indexOf(u, v);
    EXPECT_EQ(view.is_estimated[pixel], 1);
    EXPECT_EQ(view.fragments[pixel], kGlass);
    EXPECT_LE((view.vertices_world[pixel].head<3>().cast<double>() - point).norm(), kCell_m);
  }
}

TEST(EstimatedLabels, CellsBehindTheCameraAreNotSeen) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  RenderedView view = emptyViewFrom(test::pose(0, 180, 0, 0, 0, 0));
  labels.project(view);
  EXPECT_EQ(std::ranges::count(view.is_estimated, 1), 0);
}

/// Restores all bricks that `labels` stores now, with fragments up to kBottle.
EstimatedLabels restored(EstimatedLabels& labels) {
  const std::vector<RegionId> regions(kBottle.value + 1, RegionId{1});
  EstimatedLabels copy(kVoxel_m);
  for (const EstimatedLabels::StoredBrick& brick : labels.takeChanged()) {
    EXPECT_TRUE(EstimatedLabels::isValid(brick));
    copy.restore(brick, regions);
  }
  return copy;
}

TEST(EstimatedLabels, RestoredCellsBehaveLikeTheStoredOnes) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass, 4);
  writeEstimate(labels, emptyViewFrom(), 50, 40, 1.7, kBottle);
  EstimatedLabels copy = restored(labels);
  RenderedView before = emptyViewFrom(), after = emptyViewFrom();
  labels.project(before);
  copy.project(after);
  EXPECT_TRUE(after.fragments == before.fragments);
  EXPECT_TRUE(after.vertices_world == before.vertices_world);
  EXPECT_EQ(copy.cellsOfFragments(), labels.cellsOfFragments());
  for (EstimatedLabels* one : {&labels, &copy}) {
    writeEstimate(*one, emptyViewFrom(), 20, 15, 1, kBottle, 3);
    EXPECT_EQ(projectedAt(*one, 20, 15), kGlass) << "four frames said so";
    writeEstimate(*one, emptyViewFrom(), 20, 15, 1, kBottle);
    EXPECT_EQ(projectedAt(*one, 20, 15), kBottle);
  }
}

TEST(EstimatedLabels, ChangedBricksAreGivenOnce) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  ASSERT_EQ(labels.takeChanged().size(), 1U);
  EXPECT_TRUE(labels.takeChanged().empty());
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass, 20);
  EXPECT_EQ(labels.takeChanged().size(), 1U) << "of a greater confidence";
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  EXPECT_TRUE(labels.takeChanged().empty()) << "the confidence is at its greatest";
  observe(labels, measuredWall(1.5F));
  const auto removed = labels.takeChanged();
  ASSERT_EQ(removed.size(), 1U);
  EXPECT_TRUE(removed[0].words.empty());
}

TEST(EstimatedLabels, RestoredBricksAreNoChange) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  EXPECT_TRUE(restored(labels).takeChanged().empty());
}

TEST(EstimatedLabels, CellsOfDeletedFragmentsAreNotRestored) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 20, 15, 1, kGlass);
  std::vector<RegionId> regions(kBottle.value + 1, RegionId{1});
  regions[kGlass.value] = {};
  EstimatedLabels copy(kVoxel_m);
  for (const EstimatedLabels::StoredBrick& brick : labels.takeChanged()) {
    copy.restore(brick, regions);
    copy.restore(brick, std::span(regions).first(kGlass.value));
  }
  EXPECT_TRUE(copy.isEmpty());
}

/// Centres and fragments of the visited cells.
using VisitedCells = std::vector<std::pair<Eigen::Vector3f, FragmentId>>;

VisitedCells allCells(const EstimatedLabels& labels) {
  VisitedCells cells;
  labels.forEach(
      [&](const Eigen::Vector3f& center, FragmentId fragment) { cells.emplace_back(center, fragment); });
  return cells;
}

VisitedCells cellsIn(const EstimatedLabels& labels, const Eigen::Vector3i& map_brick) {
  VisitedCells cells;
  labels.forEachIn(map_brick, [&](const Eigen::Vector3f& center, FragmentId fragment) {
    cells.emplace_back(center, fragment);
  });
  return cells;
}

TEST(EstimatedLabels, EveryCellIsVisitedInItsBrickOfTheMap) {
  EstimatedLabels labels(kVoxel_m);
  for (const auto& [u, v] : {std::pair{0, 0}, std::pair{31, 23}, std::pair{63, 47}})
    writeEstimate(labels, emptyViewFrom(), u, v, 1, kGlass);
  writeEstimate(labels, emptyViewFrom(), 10, 40, 2, kBottle);
  const VisitedCells all = allCells(labels);
  ASSERT_EQ(all.size(), 4U);
  constexpr float kMapBrick_m = 8 * kVoxel_m;
  for (const auto& [center, fragment] : all) {
    const Eigen::Vector3i brick = (center / kMapBrick_m).array().floor().cast<int>();
    const VisitedCells here = cellsIn(labels, brick);
    EXPECT_EQ(std::count(here.begin(), here.end(), std::pair(center, fragment)), 1) << center.transpose();
    const std::vector<Eigen::Vector3i> bricks = labels.mapBricks();
    EXPECT_EQ(std::count(bricks.begin(), bricks.end(), brick), 1);
  }
  std::size_t visited = 0;
  for (const Eigen::Vector3i& brick : labels.mapBricks()) visited += cellsIn(labels, brick).size();
  EXPECT_EQ(visited, all.size());
  EXPECT_TRUE(cellsIn(labels, {100, 0, 0}).empty());
}

TEST(EstimatedLabels, ChangedBricksOfTheMapAreThoseWithOtherFragments) {
  EstimatedLabels labels(kVoxel_m);
  writeEstimate(labels, emptyViewFrom(), 31, 23, 1, kGlass);
  const std::vector<Eigen::Vector3i> first = labels.takeChangedMapBricks();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(cellsIn(labels, first.front()).size(), 1U);
  writeEstimate(labels, emptyViewFrom(), 31, 23, 1, kGlass, 2);
  EXPECT_TRUE(labels.takeChangedMapBricks().empty()) << "only the confidence grew";
  observe(labels, measuredWall(1));
  EXPECT_EQ(labels.takeChangedMapBricks(), first) << "the cell is gone";
  EXPECT_TRUE(allCells(labels).empty());
}

}  // namespace
}  // namespace scantrove
