#include "core/labeling/label_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "tests/kernels/labeling/label_cloud_fixture.h"

namespace scantrove::test {
namespace {

TEST_P(LabelCloudTest, EqualsTheLiteralDenseAlgorithm_OverSeveralFrames) {
  reference::DenseLabelCloud dense(kFirst, kSide, kVoxel);
  LabelingParams params;
  params.voxel_confidence = false;  // Algorithm 1 overwrites
  struct Reach {
    float vox, of_depth;
  };
  // The last: 4 mm at the sphere, where one voxel is more, and up to 9 mm at the plane.
  for (const auto& [reach_vox, of_depth] : {Reach{0.8660254F, 0}, {1.0F, 0}, {1.7F, 0}, {1.0F, 0.02F}}) {
    params.update_distance_vox = reach_vox;
    params.reach_of_depth = of_depth;
    for (int frame = 0; frame < 3; ++frame) {
      const Eigen::Isometry3d T = cameraAt(0.02 * frame, -0.015 * frame, 0.05 * frame);
      const std::vector<Eigen::Vector4f> vertices = renderScene(T);
      const std::vector<FragmentId> merged =
          randomPatches(static_cast<unsigned>(frame), 1 + 20U * static_cast<std::uint32_t>(frame));
      (void)cloud_->update(toSurface(vertices, T), merged, {}, params, *bricks_);
      dense.update(vertices, merged, kCamera, T, reach_vox * kVoxel, of_depth);
    }
  }
  std::size_t labeled = 0;
  const std::vector<std::uint32_t> sparse = denseLabels(dense, labeled);
  // Kernel and reference may contract multiply-adds differently, so a voxel that projects within an ulp of a
  // pixel's border may take the neighbouring label. Of 10^5 labelled voxels, only a handful do.
  std::size_t different = 0;
  std::size_t expected = 0;
  for (std::size_t i = 0; i < sparse.size(); ++i) {
    different += sparse[i] != dense.labels[i] ? 1U : 0U;
    expected += dense.labels[i] != 0 ? 1U : 0U;
  }
  EXPECT_GT(expected, 10000U);
  EXPECT_LE(different, expected / 20000);
  EXPECT_EQ(labeled, expected) << "a voxel outside the dense volume was labelled";
}

TEST_P(LabelCloudTest, ProjectReadsBackUpdatedLabels) {
  LabelingParams params;
  params.voxel_confidence = false;
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const std::vector<Eigen::Vector4f> vertices = renderScene(T);
  const SurfaceMaps surface = toSurface(vertices, T);
  EXPECT_THAT(cloud_->project(surface, *bricks_), testing::Each(FragmentId{}));
  std::vector<FragmentId> merged;
  for (int i = 0; i < kCamera.pixels(); ++i) merged.push_back({static_cast<std::uint32_t>(i) + 1});
  (void)cloud_->update(surface, merged, {}, params, *bricks_);
  reference::DenseLabelCloud dense(kFirst, kSide, kVoxel);
  dense.update(vertices, merged, kCamera, T, params.update_distance_vox * kVoxel);
  const std::vector<FragmentId> projected = cloud_->project(toSurface(vertices, T), *bricks_);
  std::size_t labeled = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].w() == 0) {
      EXPECT_EQ(projected[i], FragmentId{});
      continue;
    }
    const Eigen::Vector3d in_voxels = vertices[i].head<3>().cast<double>() / double{kVoxel};
    const Eigen::Vector3i voxel = in_voxels.array().floor().cast<int>().matrix() - kFirst;
    const std::uint32_t expected = dense.labels[dense.indexOf(voxel.x(), voxel.y(), voxel.z())];
    labeled += expected != 0 ? 1U : 0U;
    different += projected[i].value != expected ? 1U : 0U;
  }
  // The voxel centre of a vertex may project to a pixel without surface or outside the image; it has no label
  // then.
  EXPECT_GT(labeled, vertices.size() * 8 / 10);
  // Rounding at borders, as above.
  EXPECT_LE(different, labeled / 1000);
}

// A brick without depth would change what later frames integrate and the camera is tracked against.
TEST_P(LabelCloudTest, UpdateLeavesMissingBricksOut) {
  using Contents = std::map<std::array<int, 3>, std::vector<cl_uint>>;  // of the bricks with labels
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const std::vector<Eigen::Vector4f> vertices = renderScene(T);
  const SurfaceMaps surface = inExistingBricks(vertices, T);
  const auto writtenTo = [&](std::span<const Eigen::Vector3i> existing) {
    BrickMap map(*compute_, kVoxel);
    map.allocate(existing);
    auto cloud = LabelCloud::create(*compute_);
    EXPECT_TRUE(cloud);
    std::set<std::array<int, 3>> touched;
    for (const Eigen::Vector3i& b : (*cloud)->update(surface, randomPatches(3, 1), {}, {}, map))
      EXPECT_TRUE(touched.insert({b.x(), b.y(), b.z()}).second) << "listed once";
    EXPECT_EQ(map.brickCount(), static_cast<int>(existing.size()));
    const std::vector<cl_uint> voxels = usedPart(*compute_, map, map.pools().labels());
    Contents contents;
    for (int slot = 0; slot < map.brickCount(); ++slot) {
      const auto first = voxels.begin() + std::ptrdiff_t{slot} * BRICK_VOXELS;
      const std::vector<cl_uint> brick(first, first + BRICK_VOXELS);
      if (std::ranges::all_of(brick, [](cl_uint voxel) { return voxel == 0; })) continue;
      const Eigen::Vector3i& at = map.device().positionOf(slot);
      contents[{at.x(), at.y(), at.z()}] = brick;
    }
    EXPECT_EQ(touched.size(), contents.size());
    return contents;
  };
  EXPECT_TRUE(writtenTo({}).empty());
  Contents expected = writtenTo(bricksNear(vertices));
  ASSERT_GT(expected.size(), 40U);
  std::vector<Eigen::Vector3i> half;
  int place = 0;
  std::erase_if(expected, [&](const auto& brick) {
    const auto& [x, y, z] = brick.first;
    if (++place % 2 == 0) half.emplace_back(x, y, z);
    return place % 2 != 0;
  });
  EXPECT_EQ(writtenTo(half), expected);
}

TEST_P(LabelCloudTest, CountsTheVoxelsOfEachFragmentExactly) {
  EXPECT_THAT(cloud_->voxelsOfFragments(), testing::IsEmpty());
  std::mt19937 random(5);
  LabelingParams params;
  for (int frame = 0; frame < 40; ++frame) {
    const Eigen::Isometry3d T = cameraAt(0.01 * static_cast<double>(random() % 7), -0.01, 0.02 * (frame % 5));
    // Fragments of earlier frames and, later, of much higher numbers, for which counters grow.
    const std::uint32_t first = 1 + static_cast<std::uint32_t>(random() % 9) * (frame < 20 ? 3U : 400U);
    params.voxel_confidence = random() % 4 != 0;
    const std::array split_off{FragmentId{first + 2}, FragmentId{first + 5}};
    (void)cloud_->update(
        toSurface(renderScene(T), T), randomPatches(static_cast<unsigned>(random()), first, 15),
        random() % 3 == 0 ? std::span<const FragmentId>(split_off) : std::span<const FragmentId>(), params,
        *bricks_);
  }
  std::vector<cl_int> counted(cloud_->voxelsOfFragments().size(), 0);
  for (const cl_uint voxel : usedPart(*compute_, *bricks_, bricks_->pools().labels())) {
    if (LABEL_OF(voxel) == 0) continue;
    ASSERT_LT(LABEL_OF(voxel), counted.size());
    ++counted[LABEL_OF(voxel)];
  }
  EXPECT_EQ(cloud_->voxelsOfFragments(), counted);
  EXPECT_GT(std::ranges::count_if(counted, [](cl_int count) { return count > 0; }), 30);
}

TEST_P(LabelCloudTest, UpdateChangesNothing_InAnEmptyFrame) {
  const SurfaceMaps surface = toSurface(
      std::vector<Eigen::Vector4f>(static_cast<std::size_t>(kCamera.pixels()), Eigen::Vector4f::Zero()),
      Eigen::Isometry3d::Identity());
  EXPECT_TRUE(cloud_->update(surface, randomPatches(1, 1), {}, {}, *bricks_).empty());
  EXPECT_EQ(bricks_->brickCount(), 0);
}

TEST_P(LabelCloudTest, ExtractGivesNearSurfaceVoxels_ByBrick) {
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const SurfaceMaps surface = toSurface(renderScene(T), T);
  const auto touched = cloud_->update(surface, randomPatches(1, 1), {}, {}, *bricks_);
  const std::vector<Eigen::Vector3i> bricks(touched.begin(), touched.end());
  EXPECT_TRUE(cloud_->extract(bricks, *bricks_, 4).points.empty()) << "without fusion there is no surface";
  // Every second voxel lies on the surface, the others half a truncation away.
  std::vector<HostVoxel> voxels = usedVoxels(*compute_, *bricks_);
  for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = {i % 2 == 0 ? 1 : 16000, 1};
  writeVoxels(*compute_, *bricks_, voxels);
  const LabelCloud::Extract extract = cloud_->extract(bricks, *bricks_, 4);
  ASSERT_EQ(extract.first.size(), bricks.size() + 1);
  const std::vector<cl_uint> labels = usedPart(*compute_, *bricks_, bricks_->pools().labels());
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    const auto slot = static_cast<std::size_t>(bricks_->device().slotOf(bricks[b]));
    std::size_t expected = 0;
    for (std::size_t i = 0; i < BRICK_VOXELS; i += 2) {
      expected += LABEL_OF(labels[slot * BRICK_VOXELS + i]) != 0 ? 1U : 0U;
    }
    ASSERT_EQ(extract.first[b + 1] - extract.first[b], expected);
    for (std::uint32_t p = extract.first[b]; p < extract.first[b + 1]; ++p) {
      const LabelPoint& point = extract.points[p];
      const Eigen::Vector3f in_bricks = Eigen::Vector3f(point.x, point.y, point.z) / (8 * kVoxel);
      EXPECT_EQ(Eigen::Vector3i(in_bricks.array().floor().cast<int>()), bricks[b]);
      EXPECT_NE(point.fragment, 0U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, LabelCloudTest, testing::ValuesIn(allDevices()));

}  // namespace
}  // namespace scantrove::test
