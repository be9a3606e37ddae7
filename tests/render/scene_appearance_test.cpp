#include "tests/render/scene_fixture.h"

namespace scantrove {
namespace {

using test::kVoxel_m;
using test::SceneTest;

class SceneAppearanceTest : public SceneTest {
 protected:
  /// The wall of the fixture with colours and normals; its surface is `lift` hundredths of a voxel behind the
  /// voxel centres.
  static std::vector<CloudBrick> coloredWall(std::uint32_t left, std::uint32_t right, std::int8_t lift = 0) {
    std::vector<CloudBrick> bricks = wall(64, left, right);
    for (CloudBrick& brick : bricks) {
      for (CloudBrick::Point& p : brick.points) {
        p.color = PackedColor::of(30, 180, 60);
        p.normal = PackedNormal::of(-Eigen::Vector3f::UnitZ());
        p.height = lift;
      }
    }
    return bricks;
  }
};

TEST_F(SceneAppearanceTest, RedrawsAtOnce_WhenTheColoringChanges) {
  show(coloredWall(1, 2), {{0}, {7}, {9}});
  render();
  EXPECT_TRUE(hasHueOf(pixel(100, 120), regionColor(RegionId{7})));
  scene_.setColoring(Coloring::scene);
  EXPECT_FALSE(scene_.cloud().upToDate());
  render();
  EXPECT_TRUE(hasHueOf(pixel(100, 120), {30, 180, 60}));
  EXPECT_TRUE(hasHueOf(pixel(140, 120), {30, 180, 60}));
  scene_.setColoring(Coloring::scene);
  EXPECT_TRUE(scene_.cloud().upToDate()) << "the coloring did not change";
}

TEST_F(SceneAppearanceTest, DiscsCloseTheSurface_AtObliqueAndNearViews) {
  scene_.setColoring(Coloring::scene);
  show(coloredWall(1, 1), {{0}, {7}});
  for (const Eigen::Vector3f& eye :
       {Eigen::Vector3f(0.8F, 0, 0.55F), Eigen::Vector3f(0, 0, 0.8F), Eigen::Vector3f(0, -0.5F, 0.3F)}) {
    scene_.viewpoint().setUp(-Eigen::Vector3f::UnitY());
    scene_.viewpoint().lookAt(eye, {0, 0, 1});
    for (const SplatOverlap overlap : {SplatOverlap::quick, SplatOverlap::exact}) {
      scene_.setOverlap(overlap);
      renderFromHere();
      for (int y = 112; y < 128; ++y) {
        for (int x = 112; x < 128; ++x) ASSERT_TRUE(hasHueOf(pixel(x, y), {30, 180, 60})) << x << "," << y;
      }
    }
  }
}

TEST_F(SceneAppearanceTest, PointsWithoutColorTakeTheColorOfTheirNeighbors) {
  std::vector<CloudBrick> bricks = coloredWall(1, 1);
  for (CloudBrick& brick : bricks) {
    for (std::size_t i = 0; i < brick.points.size(); i += 3) brick.points[i].color = {};
  }
  scene_.setColoring(Coloring::scene);
  show(bricks, {{0}, {7}});
  render();
  for (int x = 100; x < 140; ++x) EXPECT_TRUE(hasHueOf(pixel(x, 120), {30, 180, 60})) << x;
}

TEST_F(SceneAppearanceTest, BackgroundIsDimmedHiddenAndRestored) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  const Rgb usual = pixel(100, 120);
  scene_.setBackground({RegionId{7}}, BackgroundStyle::dimmed);
  render();
  EXPECT_FALSE(hasHueOf(pixel(100, 120), regionColor(RegionId{7})));
  EXPECT_TRUE(hasHueOf(pixel(140, 120), regionColor(RegionId{9})));
  const Rgb dimmed = pixel(100, 120);
  scene_.setBackground({RegionId{7}}, BackgroundStyle::hidden);
  render();
  EXPECT_NE(pixel(100, 120), dimmed);
  EXPECT_FALSE(hasHueOf(pixel(100, 120), regionColor(RegionId{7})));
  EXPECT_TRUE(hasHueOf(pixel(140, 120), regionColor(RegionId{9})));
  scene_.setBackground({}, BackgroundStyle::hidden);
  render();
  EXPECT_EQ(pixel(100, 120), usual);
}

TEST_F(SceneAppearanceTest, HidesSurface_NearerThanTheClipDistance) {
  show(wall(64, 1, 1), {{0}, {7}});
  scene_.setClipDistance(0.05F);
  render();
  EXPECT_FALSE(hasHueOf(pixel(120, 120), regionColor(RegionId{7})));
  scene_.setClipDistance(-0.05F);
  render();
  EXPECT_TRUE(hasHueOf(pixel(120, 120), regionColor(RegionId{7})));
  scene_.setClipDistance(std::nullopt);
  EXPECT_FALSE(scene_.clipDistance());
}

TEST_F(SceneAppearanceTest, DrawsPoints_OnTheSurface) {
  // The voxel centres are half a voxel above the surface (normal -z), so it lies half a voxel farther along
  // z.
  show(coloredWall(1, 1, 50), {{0}, {7}});
  const auto picked = scene_.cloud().pick({0, 0, 0}, {0, 0, 1}, 0.001F);
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->z(), kVoxel_m * (std::floor(1 / kVoxel_m) + 0.5F), 1e-4);
}

TEST_F(SceneAppearanceTest, DrawsTheMiddleOfTheViewFinest_WithinABudget) {
  // Half a metre away a voxel covers several pixels, so a coarse level would show blocks.
  show(wall(384, 1, 1), {{0}, {7}});
  scene_.viewpoint().setUp(-Eigen::Vector3f::UnitY());
  scene_.viewpoint().lookAt({0, 0, 0.5F}, {0, 0, 1});
  renderFromHere(20'000);
  EXPECT_LE(scene_.cloud().drawnPointCount(), 20'000U);
  EXPECT_GT(scene_.cloud().drawnPointCount(), 384U * 384U / 64);
}

TEST_F(SceneAppearanceTest, DrawsTheMeasuredLine_ThroughTheSurface) {
  show(wall(64, 1, 1), {{0}, {7}});
  scene_.showMeasure({{-0.1F, 0, 1.2F}, {0.1F, 0, 1.2F}});
  render();
  int yellow = 0;
  for (int y = 115; y < 125; ++y) yellow += hasHueOf(pixel(120, y), {255, 214, 64}) ? 1 : 0;
  EXPECT_GE(yellow, 2);
  scene_.showMeasure({});
  render();
  for (int y = 115; y < 125; ++y) EXPECT_FALSE(hasHueOf(pixel(120, y), {255, 214, 64}));
}

}  // namespace
}  // namespace scantrove
