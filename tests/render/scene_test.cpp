#include <gtest/gtest.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/exchange/region_palette.h"
#include "ui/scene/label_cloud_scene.h"

namespace scantrove {
namespace {

constexpr int kSize = 240;
constexpr float kVoxel_m = 3.0F / 512.0F;

/// A scene in a window nobody sees.
class SceneTest : public testing::Test {
 protected:
  SceneTest() : window_(vtkSmartPointer<vtkRenderWindow>::New()) {
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(kSize, kSize);
    window_->AddRenderer(scene_.renderer());
    scene_.setGridVisible(false);
    scene_.setFollowing(false);
  }
  ~SceneTest() override { window_->Finalize(); }

  /// A wall of `side` x `side` voxels at depth 1 m, labelled `left` and `right` of the optical axis.
  static std::vector<CloudBrick> wall(int side, std::uint32_t left, std::uint32_t right,
                                      std::uint64_t version = 1) {
    std::vector<CloudBrick> bricks;
    const int half = side / 16;
    const int z = static_cast<int>(1.0F / kVoxel_m);
    for (int by = -half; by < half; ++by) {
      for (int bx = -half; bx < half; ++bx) {
        CloudBrick brick{Eigen::Vector3i(bx, by, z / 8), version, {}};
        for (int i = 0; i < 64; ++i) {
          brick.points.push_back({kVoxel_m * static_cast<float>(8 * bx + i % 8),
                                  kVoxel_m * static_cast<float>(8 * by + i / 8),
                                  kVoxel_m * static_cast<float>(z), FragmentId{bx < 0 ? left : right}});
        }
        bricks.push_back(std::move(brick));
      }
    }
    return bricks;
  }

  void show(const std::vector<CloudBrick>& bricks, const std::vector<RegionId>& region_of_fragment) {
    ScanSnapshot snapshot;
    snapshot.changed_bricks = bricks;
    for (std::uint32_t fragment = 1; fragment < region_of_fragment.size(); ++fragment)
      snapshot.changed_regions.push_back({FragmentId{fragment}, region_of_fragment[fragment]});
    scene_.update(snapshot);
  }

  /// Renders from the origin along +z with y down, as a camera at the identity pose sees it.
  void render(std::size_t budget = 1'000'000) {
    scene_.viewpoint().setUp(-Eigen::Vector3f::UnitY());
    scene_.viewpoint().lookAt({0, 0, 0}, {0, 0, 1});
    scene_.prepare(kSize, kSize, budget, 10'000'000);
    window_->Render();
    pixels_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
    window_->GetPixelData(0, 0, kSize - 1, kSize - 1, 0, pixels_);
  }

  /// `x` from the left, `y` from the top.
  Rgb pixel(int x, int y) {
    Rgb color{};
    for (int c = 0; c < 3; ++c) {
      color[static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(pixels_->GetTypedComponent((kSize - 1 - y) * kSize + x, c));
    }
    return color;
  }

  /// The pixel is `color` at some brightness (points are shaded).
  static testing::AssertionResult hasHueOf(const Rgb& pixel, const Rgb& color) {
    const double scale =
        (pixel[0] + pixel[1] + pixel[2]) / static_cast<double>(color[0] + color[1] + color[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(pixel[c] - scale * color[c]) > 4) {
        return testing::AssertionFailure()
               << int(pixel[0]) << " " << int(pixel[1]) << " " << int(pixel[2]) << " is not " << int(color[0])
               << " " << int(color[1]) << " " << int(color[2]);
      }
    }
    return scale > 0.4 ? testing::AssertionSuccess() : testing::AssertionFailure() << "too dark: " << scale;
  }

  vtkSmartPointer<vtkRenderWindow> window_;
  LabelCloudScene scene_;
  vtkSmartPointer<vtkUnsignedCharArray> pixels_;
};

TEST_F(SceneTest, PointsHaveTheirRegionsColoursAndCloseTheSurface) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  EXPECT_EQ(scene_.cloud().pointCount(), 64U * 64U);
  // x grows to the right, as in the image of the sensor.
  for (int y = 90; y < 150; y += 7) {
    for (int x = 90; x < 115; x += 3) {
      EXPECT_TRUE(hasHueOf(pixel(x, y), regionColor(RegionId{7}))) << x << "," << y;
      EXPECT_TRUE(hasHueOf(pixel(240 - x, y), regionColor(RegionId{9}))) << 240 - x << "," << y;
    }
  }
}

TEST_F(SceneTest, MergedRegionsAreRecoloured) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  show({}, {{0}, {7}, {7}});
  EXPECT_FALSE(scene_.cloud().upToDate());
  render();
  EXPECT_TRUE(scene_.cloud().upToDate());
  EXPECT_TRUE(hasHueOf(pixel(140, 120), regionColor(RegionId{7})));
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

TEST_F(SceneTest, FewerPointsWithinABudgetStillCloseTheSurface) {
  show(wall(128, 1, 1), {{0}, {7}});
  render(3000);
  EXPECT_LE(scene_.cloud().drawnPointCount(), 3000U);
  int covered = 0;
  for (int y = 80; y < 160; ++y) {
    for (int x = 80; x < 160; ++x) covered += hasHueOf(pixel(x, y), regionColor(RegionId{7})) ? 1 : 0;
  }
  EXPECT_GT(covered, 80 * 80 * 8 / 10);
}

TEST_F(SceneTest, ClearEmptiesIt) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  render();
  scene_.clear();
  EXPECT_EQ(scene_.cloud().pointCount(), 0U);
  EXPECT_EQ(scene_.cloud().chunkCount(), 0U);
  render();
  const Rgb middle = pixel(120, 120);
  EXPECT_FALSE(hasHueOf(middle, regionColor(RegionId{7})));
}

TEST_F(SceneTest, ViewpointCirclesItsTargetAndStaysUpright) {
  OrbitCamera camera;
  camera.setUp(-Eigen::Vector3f::UnitY());
  camera.lookAt({0, -1, 0}, {0, 0, 2});
  const float distance = camera.distance();
  camera.orbit(1.0F, 0.4F);
  EXPECT_NEAR((camera.eye() - camera.target()).norm(), distance, 1e-4F);
  camera.orbit(0, 10);  // over the top is stopped short of it
  EXPECT_GT((camera.eye() - camera.target()).normalized().dot(camera.up()), 0.98F);
  EXPECT_LT((camera.eye() - camera.target()).normalized().dot(camera.up()), 0.9999F);
}

TEST_F(SceneTest, WhatArrivesDoesNotTurnAViewThatAPersonTook) {
  // A floor seen by a camera that looks 40 degrees down on it: upright is -z and not what the camera holds
  // up.
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
