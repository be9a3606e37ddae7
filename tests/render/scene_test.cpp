#include <numbers>

#include "tests/render/scene_fixture.h"

namespace scantrove {
namespace {

using test::SceneTest;

TEST_F(SceneTest, PointsHaveRegionColorsAndCloseTheSurface) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  EXPECT_EQ(scene_.cloud().pointCount(), 64U * 64U);
  // x points right, as in the image of the sensor.
  for (int y = 90; y < 150; y += 7) {
    for (int x = 90; x < 115; x += 3) {
      EXPECT_TRUE(hasHueOf(pixel(x, y), regionColor(RegionId{7}))) << x << "," << y;
      EXPECT_TRUE(hasHueOf(pixel(240 - x, y), regionColor(RegionId{9}))) << 240 - x << "," << y;
    }
  }
}

TEST_F(SceneTest, MergedRegionsAreRecolored) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  show({}, {{0}, {7}, {7}});
  EXPECT_FALSE(scene_.cloud().upToDate());
  render();
  EXPECT_TRUE(scene_.cloud().upToDate());
  EXPECT_TRUE(hasHueOf(pixel(140, 120), regionColor(RegionId{7})));
}

// A scan may change all bricks, but changes by a person are drawn first.
TEST_F(SceneTest, DrawsUserChangesFirst) {
  std::vector<CloudBrick> bricks = wall(512, 1, 2);
  for (CloudBrick& brick : bricks) {
    const bool is_within = (brick.position.head<2>().array() >= 0).all() && brick.position.x() < 8 &&
                           brick.position.y() < 16;  // one chunk
    if (!is_within) continue;
    for (CloudBrick::Point& point : brick.points) point.fragment = FragmentId{3};
  }
  show(bricks, {{}, RegionId{1}, RegionId{2}, RegionId{3}});
  render();
  ASSERT_TRUE(hasHueOf(pixel(130, 130), regionColor(RegionId{3})));
  show({}, {{}, RegionId{11}, RegionId{12}});
  EXPECT_FALSE(renderFromHere(1'000'000, 1)) << "one chunk at a time";
  ScanSnapshot snapshot;
  snapshot.changed_regions = {{FragmentId{3}, RegionId{33}, true}};
  scene_.update(snapshot);
  EXPECT_FALSE(renderFromHere(1'000'000, 1));
  EXPECT_TRUE(hasHueOf(pixel(130, 130), regionColor(RegionId{33})));
  EXPECT_FALSE(scene_.cloud().upToDate()) << "other changes still wait";
}

TEST_F(SceneTest, DrawingInPartsEqualsDrawingAtOnce) {
  show(wall(512, 1, 2), {{}, RegionId{4}, RegionId{9}});
  scene_.setGridVisible(true);
  render();
  const auto pixels = [this] {
    const auto* first = pixels_->GetPointer(0);
    return std::vector<unsigned char>(first, first + pixels_->GetNumberOfValues());
  };
  const std::vector<unsigned char> complete = pixels();
  scene_.viewpoint().orbit(0.5F, 0.2F);  // another image is drawn before
  renderFromHere();
  ASSERT_NE(pixels(), complete);
  scene_.viewpoint().setUp(-Eigen::Vector3f::UnitY());
  scene_.viewpoint().lookAt({0, 0, 0}, {0, 0, 1});
  scene_.prepare(test::kSize, test::kSize, 1'000'000, 10'000'000);
  scene_.beginParts(20'000);
  int parts = 0;
  do {
    ++parts;
    window_->Render();
  } while (scene_.nextPart());
  readPixels();
  EXPECT_EQ(parts, 4) << "one for each chunk in view";
  EXPECT_EQ(pixels(), complete);
  renderFromHere();
  EXPECT_EQ(pixels(), complete) << "drawn at once again";
}

TEST_F(SceneTest, NewerBrickReplacesAndOlderIsIgnored) {
  show(wall(64, 1, 1, 5), {{0}, {7}, {9}});
  show(wall(64, 2, 2, 4), {{0}, {7}, {9}});
  render();
  EXPECT_TRUE(hasHueOf(pixel(120, 120), regionColor(RegionId{7})));
  show(wall(64, 2, 2, 6), {{0}, {7}, {9}});
  render();
  EXPECT_TRUE(hasHueOf(pixel(120, 120), regionColor(RegionId{9})));
  EXPECT_EQ(scene_.cloud().pointCount(), 64U * 64U);
}

TEST_F(SceneTest, CloseTheSurface_WithFewPoints) {
  show(wall(128, 1, 1), {{0}, {7}});
  render(3000);
  EXPECT_LE(scene_.cloud().drawnPointCount(), 3000U);
  int covered = 0;
  for (int y = 80; y < 160; ++y) {
    for (int x = 80; x < 160; ++x) covered += hasHueOf(pixel(x, y), regionColor(RegionId{7})) ? 1 : 0;
  }
  EXPECT_GT(covered, 80 * 80 * 8 / 10);
}

TEST_F(SceneTest, DrawsASelectionFinely_UnlessItIsAll) {
  constexpr std::size_t kBudget = 8000;
  std::vector<CloudBrick> bricks = wall(512, 1, 1);
  for (CloudBrick& brick : bricks) {
    if (brick.position.x() != -10 || brick.position.y() != -4) continue;
    for (CloudBrick::Point& point : brick.points) point.fragment = FragmentId{2};
  }
  show(bricks, {{0}, {7}, {9}});
  render(kBudget);
  const std::size_t coarse = scene_.cloud().drawnPointCount();
  scene_.setSelected({RegionId{9}});
  render(kBudget);
  // One chunk of 128 x 128 points has at least every fourth point instead of at most every sixteenth.
  EXPECT_GE(scene_.cloud().drawnPointCount(), coarse + 128 * 128 / 4 - 128 * 128 / 16);
  EXPECT_LE(scene_.cloud().drawnPointCount(), kBudget + 128 * 128 / 4);
  scene_.setSelected({RegionId{7}});
  render(kBudget);
  EXPECT_EQ(scene_.cloud().drawnPointCount(), coarse) << "the budget does not allow all points";
  ScanSnapshot joined;
  joined.changed_regions.push_back({FragmentId{2}, RegionId{8}});
  scene_.update(joined);
  scene_.setSelected({RegionId{8}});
  render(kBudget);
  EXPECT_GT(scene_.cloud().drawnPointCount(), coarse);
  scene_.setSelected({});
  render(kBudget);
  EXPECT_EQ(scene_.cloud().drawnPointCount(), coarse);
}

TEST_F(SceneTest, ClearRemovesAllPoints) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  scene_.clear();
  EXPECT_EQ(scene_.cloud().pointCount(), 0U);
  EXPECT_EQ(scene_.cloud().chunkCount(), 0U);
  render();
  const Rgb middle = pixel(120, 120);
  EXPECT_FALSE(hasHueOf(middle, regionColor(RegionId{7})));
}

TEST_F(SceneTest, OrbitKeepsDistanceAndStaysUpright) {
  OrbitCamera camera;
  camera.setUp(-Eigen::Vector3f::UnitY());
  camera.lookAt({0, -1, 0}, {0, 0, 2});
  const float distance = camera.distance();
  camera.orbit(1.0F, 0.4F);
  EXPECT_NEAR((camera.eye() - camera.target()).norm(), distance, 1e-4F);
  camera.orbit(0, 10);  // stops just before the top
  EXPECT_GT((camera.eye() - camera.target()).normalized().dot(camera.up()), 0.98F);
  EXPECT_LT((camera.eye() - camera.target()).normalized().dot(camera.up()), 0.9999F);
}

TEST_F(SceneTest, KeepsAUserView_WhenBricksArrive) {
  // A camera looks down on a floor by 40 degrees: up is -z, not the camera's up direction.
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.pose.state = TrackingState::tracking;
  snapshot.pose.T_world_camera.linear() =
      Eigen::AngleAxisd(50 * std::numbers::pi / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
  snapshot.changed_regions = {{FragmentId{1}, RegionId{1}}};
  scene_.update(snapshot);
  const Eigen::Vector3f eye = scene_.viewpoint().eye();
  const Eigen::Vector3f up = scene_.viewpoint().up();
  snapshot.changed_bricks = wall(384, 1, 1);
  scene_.update(snapshot);
  EXPECT_EQ(scene_.viewpoint().eye(), eye);
  EXPECT_EQ(scene_.viewpoint().up(), up);
  scene_.setFollowing(true);
  EXPECT_GT(scene_.viewpoint().up().dot(-Eigen::Vector3f::UnitZ()), 0.99F);
}

}  // namespace
}  // namespace scantrove
