// Compares the id image for picking with the drawn image.
#include <gtest/gtest.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <random>

#include "core/exchange/region_palette.h"
#include "ui/scene/label_cloud_scene.h"

namespace scantrove {
namespace {

constexpr int kIdSize = 240;
constexpr float kIdVoxel_m = 3.0F / 512.0F;

/// A wall at 1.2 m of fragment 1, and in front of its middle a square of fragment 2 at 0.8 m.
std::vector<CloudBrick> wallAndSquare() {
  std::vector<CloudBrick> bricks;
  const auto add = [&](int half, int brick_z, FragmentId fragment) {
    for (int by = -half; by < half; ++by) {
      for (int bx = -half; bx < half; ++bx) {
        CloudBrick brick{Eigen::Vector3i(bx, by, brick_z), 1, {}};
        for (int i = 0; i < 64; ++i) {
          const Eigen::Vector3f position_m =
              kIdVoxel_m * (8 * brick.position.cast<float>() +
                            Eigen::Vector3f(static_cast<float>(i % 8), static_cast<float>(i / 8), 4));
          brick.points.push_back({position_m.x(), position_m.y(), position_m.z(), fragment, {}, 0, {}});
        }
        bricks.push_back(std::move(brick));
      }
    }
  };
  add(12, 25, FragmentId{1});
  add(3, 17, FragmentId{2});
  return bricks;
}

class CloudIdsTest : public testing::Test {
 protected:
  CloudIdsTest() : window_(vtkSmartPointer<vtkRenderWindow>::New()) {
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(kIdSize, kIdSize);
    window_->AddRenderer(scene_.renderer());
    scene_.setGridVisible(false);
    scene_.setFollowing(false);
    ScanSnapshot snapshot;
    snapshot.changed_bricks = wallAndSquare();
    snapshot.changed_regions = {{FragmentId{1}, RegionId{3}}, {FragmentId{2}, RegionId{8}}};
    scene_.update(snapshot);
  }
  ~CloudIdsTest() override { window_->Finalize(); }

  void render(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, std::size_t budget = 1'000'000) {
    scene_.viewpoint().setUp(-Eigen::Vector3f::UnitY());
    scene_.viewpoint().lookAt(eye, target);
    scene_.prepare(kIdSize, kIdSize, budget, 10'000'000);
    window_->Render();
    pixels_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
    window_->GetPixelData(0, 0, kIdSize - 1, kIdSize - 1, 0, pixels_);
    scene_.drawIds(kIdSize, kIdSize, 1, ids_);
  }

  /// True if the drawn pixel has the hue of the region.
  bool isDrawnAs(int x, int y, RegionId region) {
    const Rgb color = regionColor(region);
    std::array<double, 3> drawn{};
    for (int c = 0; c < 3; ++c)
      drawn[static_cast<std::size_t>(c)] = pixels_->GetTypedComponent((kIdSize - 1 - y) * kIdSize + x, c);
    const double scale =
        (drawn[0] + drawn[1] + drawn[2]) / static_cast<double>(color[0] + color[1] + color[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(drawn[c] - scale * color[c]) > 6) return false;
    }
    return true;
  }

  LabelCloudScene scene_;
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkUnsignedCharArray> pixels_;
  CloudIds ids_;
};

TEST_F(CloudIdsTest, MatchTheDrawnRegion_AtEveryPixel) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> offset(-0.25F, 0.25F);
  for (const std::size_t budget : {1'000'000UL, 9'000UL}) {  // all points, and a coarse level
    for (int view = 0; view < 6; ++view) {
      render({offset(random), offset(random), offset(random)}, {0, 0, 1}, budget);
      int checked = 0, right = 0;
      for (int y = 0; y < kIdSize; ++y) {
        for (int x = 0; x < kIdSize; ++x) {
          const FragmentId fragment = ids_.fragmentAt(x, y);
          if (!fragment) continue;
          ++checked;
          right += isDrawnAs(x, y, scene_.cloud().regionOf(fragment)) ? 1 : 0;
        }
      }
      EXPECT_GT(checked, 3000);
      // Region borders may differ by half a pixel.
      EXPECT_GT(right, 0.985 * checked) << "view " << view << ", budget " << budget;
    }
  }
}

TEST_F(CloudIdsTest, GiveFragmentAndPosition_OfTheNearestSurface) {
  render({0, 0, 0}, {0, 0, 1});
  const int middle = kIdSize / 2;
  EXPECT_EQ(ids_.fragmentAt(middle, middle), FragmentId{2});
  const auto near = ids_.pointAt(middle, middle);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->z(), (17 * 8 + 4) * kIdVoxel_m, 1e-3F);
  EXPECT_NEAR(near->x(), 0, 0.01F);
  // The vertical field of view is 40 degrees. This pixel shows the wall at 1.2 m, 70 pixels from the middle.
  const auto far = ids_.pointAt(middle + 70, middle);
  ASSERT_TRUE(far);
  const float z = (25 * 8 + 4) * kIdVoxel_m;
  EXPECT_EQ(ids_.fragmentAt(middle + 70, middle), FragmentId{1});
  EXPECT_NEAR(far->z(), z, 1e-3F);
  EXPECT_NEAR(far->x(), 70.5F / 120 * std::tan(20.0F * 3.14159265F / 180) * z, 0.004F);
}

TEST_F(CloudIdsTest, OfAPartEqualTheCompleteImage) {
  render({0.1F, -0.05F, 0}, {0, 0, 1});
  CloudIds part_ids;
  for (const CloudIds::Part part : {CloudIds::Part{100, 60, 40, 30}, {0, 0, 9, 9}, {231, 231, 9, 9}}) {
    scene_.drawIdsFinely(kIdSize, kIdSize, 1, part, part_ids);
    ASSERT_EQ(part_ids.width(), part.width);
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) {
        ASSERT_EQ(part_ids.fragmentAt(x, y), ids_.fragmentAt(part.x + x, part.y + y)) << x << ", " << y;
        const auto in_part = part_ids.pointAt(x, y), in_image = ids_.pointAt(part.x + x, part.y + y);
        ASSERT_EQ(in_part.has_value(), in_image.has_value());
        if (in_part) {
          EXPECT_LT((*in_part - *in_image).norm(), 1e-4F);
        }
      }
    }
  }
}

TEST_F(CloudIdsTest, FineIdsAreIndependent_OfTheDrawnLevel) {
  render({0, 0, 0}, {0, 0, 1});
  const std::vector<FragmentId> exact = ids_.fragments();
  render({0, 0, 0}, {0, 0, 1}, 2'000);
  ASSERT_NE(ids_.fragments(), exact) << "the level of detail did not change";
  CloudIds fine_ids;
  scene_.drawIdsFinely(kIdSize, kIdSize, 1, {0, 0, kIdSize, kIdSize}, fine_ids);
  EXPECT_EQ(fine_ids.fragments(), exact);
}

TEST_F(CloudIdsTest, FineIdsEqualCoarseOnes_AtPixelCentres) {
  render({0.1F, -0.05F, 0}, {0, 0, 1});
  constexpr int kParts = 3;
  const CloudIds::Part part{60, 40, 120, 90};
  CloudIds fine_ids;
  scene_.drawIdsFinely(kIdSize, kIdSize, kParts,
                       {kParts * part.x, kParts * part.y, kParts * part.width, kParts * part.height},
                       fine_ids);
  int edges = 0;
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const FragmentId middle = fine_ids.fragmentAt(kParts * x + 1, kParts * y + 1);
      ASSERT_EQ(middle, ids_.fragmentAt(part.x + x, part.y + y)) << x << ", " << y;
      edges += middle != fine_ids.fragmentAt(kParts * x, kParts * y + 1) ? 1 : 0;
    }
  }
  EXPECT_GT(edges, 10) << "no edge runs through a pixel";
}

TEST_F(CloudIdsTest, AreEmpty_BesideTheScene) {
  render({0, 0, 0}, {0, 0, -1});
  EXPECT_FALSE(ids_.fragmentAt(kIdSize / 2, kIdSize / 2));
  EXPECT_FALSE(ids_.pointAt(kIdSize / 2, kIdSize / 2));
}

}  // namespace
}  // namespace scantrove
