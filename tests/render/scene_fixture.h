#pragma once
#include <gtest/gtest.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/exchange/region_palette.h"
#include "ui/scene/label_cloud_scene.h"

namespace scantrove::test {

inline constexpr int kSize = 240;
inline constexpr float kVoxel_m = 3.0F / 512.0F;

/// A scene in an off-screen window.
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

  /// A wall of `side` x `side` voxels at 1 m; fragment `left` is left of the optical axis, `right` right of
  /// it.
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

  /// Renders the view of a camera at the identity pose: along +z with y down.
  void render(std::size_t budget = 1'000'000) {
    scene_.viewpoint().setUp(-Eigen::Vector3f::UnitY());
    scene_.viewpoint().lookAt({0, 0, 0}, {0, 0, 1});
    renderFromHere(budget);
  }

  /// Returns true if all changes were rebuilt.
  bool renderFromHere(std::size_t budget = 1'000'000, std::size_t rebuild_budget = 10'000'000) {
    const bool is_complete = scene_.prepare(kSize, kSize, budget, rebuild_budget);
    window_->Render();
    readPixels();
    return is_complete;
  }

  void readPixels() {
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

}  // namespace scantrove::test
