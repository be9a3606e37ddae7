#include "core/labeling/label_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "core/compute/device_choice.h"
#include "core/labeling/kernels/label_voxel.h"
#include "tests/reference/dense_label_cloud.h"
#include "tests/support/brick_contents.h"

namespace scantrove {
namespace {

constexpr float kVoxel = 0.006F;
constexpr int kSide = 152;                                  // voxels of the dense volume: 0.912 m
const Eigen::Vector3i kFirst(-76, -76, -40);                // all axes include negative coordinates
const Intrinsics kCamera{110, 112, 52.3F, 41.1F, 107, 83};  // odd sizes

/// A sphere in front of a slanted plane, seen from `T`; every 17th pixel has no surface.
std::vector<Eigen::Vector4f> renderScene(const Eigen::Isometry3d& T) {
  const Eigen::Vector3f center(0.02F, 0.01F, 0.12F);
  const float radius = 0.08F;
  const Eigen::Vector3f normal = Eigen::Vector3f(0.1F, -0.2F, -1).normalized();
  const float offset = normal.dot(Eigen::Vector3f(0, 0, 0.3F));
  const Eigen::Vector3f origin = T.translation().cast<float>();
  std::vector<Eigen::Vector4f> vertices;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Eigen::Vector3f ray =
          T.linear().cast<float>() *
          kCamera.backProject(static_cast<float>(u), static_cast<float>(v), 1).normalized();
      float distance = (offset - normal.dot(origin)) / normal.dot(ray);
      const Eigen::Vector3f to_center = center - origin;
      const float along = to_center.dot(ray);
      const float miss = to_center.squaredNorm() - along * along;
      if (miss < radius * radius) distance = std::min(distance, along - std::sqrt(radius * radius - miss));
      const bool none = (u + v * kCamera.width) % 17 == 0 || !(distance > 0);
      const Eigen::Vector3f p = origin + distance * ray;
      vertices.push_back(none ? Eigen::Vector4f::Zero() : Eigen::Vector4f(p.x(), p.y(), p.z(), 1));
    }
  }
  return vertices;
}

/// The bricks within two voxels of a vertex: more than any update reaches.
std::vector<Eigen::Vector3i> bricksNear(const std::vector<Eigen::Vector4f>& vertices) {
  std::set<std::array<int, 3>> near;
  for (const Eigen::Vector4f& vertex : vertices) {
    if (vertex.w() == 0) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f step(corner & 1 ? 2.0F : -2.0F, corner & 2 ? 2.0F : -2.0F,
                                 corner & 4 ? 2.0F : -2.0F);
      const Eigen::Vector3i at = ((vertex.head<3>() / kVoxel + step) / 8).array().floor().cast<int>();
      near.insert({at.x(), at.y(), at.z()});
    }
  }
  std::vector<Eigen::Vector3i> bricks;
  for (const auto& [x, y, z] : near) bricks.emplace_back(x, y, z);
  return bricks;
}

class LabelCloudTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    auto compute = ComputeContext::create({std::to_string(GetParam()), false});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
    auto cloud = LabelCloud::create(*compute_);
    ASSERT_TRUE(cloud) << cloud.error().message();
    cloud_ = std::move(*cloud);
    bricks_ = std::make_unique<BrickMap>(*compute_, kVoxel);
  }

  /// Allocates the bricks of the surface, as its integration does. Those that it adds lie outside the window,
  /// where a slower lookup finds them.
  SurfaceMaps toSurface(const std::vector<Eigen::Vector4f>& vertices, const Eigen::Isometry3d& T) {
    SurfaceMaps surface = inExistingBricks(vertices, T);
    bricks_->allocate(bricksNear(vertices));
    return surface;
  }
  SurfaceMaps inExistingBricks(const std::vector<Eigen::Vector4f>& vertices, const Eigen::Isometry3d& T) {
    SurfaceMaps surface;
    surface.K = kCamera;
    surface.T_world_camera = T;
    surface.vertices_world = Buffer<cl_float4>(compute_->context(), vertices.size());
    std::vector<cl_float4> values;
    for (const auto& v : vertices) values.push_back({{v.x(), v.y(), v.z(), v.w()}});
    surface.vertices_world.write(compute_->queue(), values);
    surface.window = test::windowOfAll(*compute_, *bricks_);
    return surface;
  }

  /// Labels of all voxels of the dense volume; `labeled` counts all labelled voxels of the map.
  std::vector<std::uint32_t> denseLabels(const reference::DenseLabelCloud& shape, std::size_t& labeled) {
    std::vector<std::uint32_t> dense(shape.labels.size(), 0);
    const std::vector<cl_uint> voxels = test::usedPart(*compute_, *bricks_, bricks_->pools().labels());
    labeled = 0;
    for (int slot = 0; slot < bricks_->brickCount(); ++slot) {
      for (int i = 0; i < BRICK_VOXELS; ++i) {
        const auto at = static_cast<std::size_t>(slot) * BRICK_VOXELS + static_cast<std::size_t>(i);
        const std::uint32_t label = LABEL_OF(voxels[at]);
        if (label == 0) continue;
        ++labeled;
        const Eigen::Vector3i voxel =
            8 * bricks_->device().positionOf(slot) + Eigen::Vector3i(i % 8, i / 8 % 8, i / 64) - shape.first;
        if ((voxel.array() < 0).any() || (voxel.array() >= shape.side).any()) continue;
        dense[shape.indexOf(voxel.x(), voxel.y(), voxel.z())] = label;
      }
    }
    return dense;
  }

  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<LabelCloud> cloud_;
  std::unique_ptr<BrickMap> bricks_;
};

std::vector<int> allDevices() {
  std::vector<int> indices;
  for (const DeviceInfo& info : listDevices()) indices.push_back(info.index);
  return indices;
}

/// Patches that cycle through `fragments` fragments from `first` on; some pixels have none.
std::vector<FragmentId> randomPatches(unsigned seed, std::uint32_t first, std::uint32_t fragments = 20) {
  std::mt19937 random(seed);
  std::vector<FragmentId> patches;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const bool none = random() % 29 == 0;
      patches.push_back({none ? 0 : first + static_cast<std::uint32_t>(u / 11 + v / 9) % fragments});
    }
  }
  return patches;
}

std::vector<FragmentId> onlyFragment(FragmentId fragment) {
  return std::vector<FragmentId>(static_cast<std::size_t>(kCamera.pixels()), fragment);
}

Eigen::Isometry3d cameraAt(double x, double y, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, y, -0.17);
  T.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.13, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return T;
}

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
    const std::vector<cl_uint> voxels = test::usedPart(*compute_, map, map.pools().labels());
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

/// Updates of one view, and the resulting fragments of the cloud.
class LabelCloudConfidenceTest : public LabelCloudTest {
 protected:
  void write(FragmentId fragment, int times, std::span<const FragmentId> split_off = {}) {
    const Eigen::Isometry3d T = cameraAt(0, 0, 0);
    const SurfaceMaps surface = toSurface(renderScene(T), T);
    for (int i = 0; i < times; ++i) {
      (void)cloud_->update(surface, onlyFragment(fragment), split_off, params_, *bricks_);
    }
  }
  std::set<std::uint32_t> fragmentsInCloud() {
    std::size_t labeled = 0;
    std::set<std::uint32_t> fragments;
    for (const std::uint32_t fragment :
         denseLabels(reference::DenseLabelCloud(kFirst, kSide, kVoxel), labeled)) {
      if (fragment != 0) fragments.insert(fragment);
    }
    return fragments;
  }

  const FragmentId first_{1}, second_{2};
  LabelingParams params_;
};

TEST_P(LabelCloudConfidenceTest, ReplacesAFragment_AfterAsManyFramesAsItsConfidence) {
  write(first_, 3);
  write(second_, 2);
  EXPECT_EQ(fragmentsInCloud(), std::set{first_.value});
  write(second_, 1);
  EXPECT_EQ(fragmentsInCloud(), std::set{second_.value});
  // The confidence is one now, so one frame is enough.
  write(first_, 1);
  EXPECT_EQ(fragmentsInCloud(), std::set{first_.value});
}

TEST_P(LabelCloudConfidenceTest, ConfidenceIsLimited) {
  write(first_, 3 * static_cast<int>(LABEL_CONFIDENCE_MAX));
  write(second_, static_cast<int>(LABEL_CONFIDENCE_MAX) - 1);
  EXPECT_EQ(fragmentsInCloud(), std::set{first_.value});
  write(second_, 1);
  EXPECT_EQ(fragmentsInCloud(), std::set{second_.value});
}

TEST_P(LabelCloudConfidenceTest, ReplacesAFragmentAtOnce_AfterASplit) {
  write(first_, 8);
  write(second_, 1, std::array{second_});
  EXPECT_EQ(fragmentsInCloud(), std::set{second_.value});
  write(first_, 1);
  EXPECT_EQ(fragmentsInCloud(), std::set{first_.value}) << "a split voxel starts with confidence one";
}

TEST_P(LabelCloudConfidenceTest, WritesConfirmationsInTurns_AtFullConfidence) {
  write(first_, 1);
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const SurfaceMaps surface = toSurface(renderScene(T), T);
  // Sets the confidence of all labelled voxels.
  const auto setConfidence = [&](std::uint32_t confidence) {
    std::vector<cl_uint> voxels = test::usedPart(*compute_, *bricks_, bricks_->pools().labels());
    for (cl_uint& voxel : voxels) voxel = LABEL_OF(voxel) == 0 ? 0 : LABEL_VOXEL(LABEL_OF(voxel), confidence);
    bricks_->pools().labels().write(compute_->queue(), voxels);
  };
  // The voxels that an update writes if projection found all of them at full confidence.
  const auto writtenBy = [&](FragmentId fragment) {
    setConfidence(LABEL_CONFIDENCE_MAX);
    (void)cloud_->project(surface, *bricks_);
    setConfidence(5);
    (void)cloud_->update(surface, onlyFragment(fragment), {}, params_, *bricks_);
    std::set<std::size_t> written;
    const std::vector<cl_uint> voxels = test::usedPart(*compute_, *bricks_, bricks_->pools().labels());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      if (voxels[i] != 0 && CONFIDENCE_OF(voxels[i]) != 5) written.insert(i);
    }
    return written;
  };
  const std::set<std::size_t> all = writtenBy(second_);
  ASSERT_GT(all.size(), 5000U) << "new labels are written at once";
  std::set<std::size_t> in_turns;
  for (int turn = 0; turn < 4; ++turn) {
    const std::set<std::size_t> now = writtenBy(first_);
    EXPECT_GT(now.size(), all.size() / 8);
    EXPECT_LT(now.size(), all.size() / 2);
    in_turns.insert(now.begin(), now.end());
  }
  EXPECT_EQ(in_turns, all);
}

TEST_P(LabelCloudConfidenceTest, EveryFrameOverwrites_WithoutConfidence) {
  params_.voxel_confidence = false;
  write(first_, 8);
  write(second_, 1);
  EXPECT_EQ(fragmentsInCloud(), std::set{second_.value});
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
  for (const cl_uint voxel : test::usedPart(*compute_, *bricks_, bricks_->pools().labels())) {
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
  std::vector<test::HostVoxel> voxels = test::usedVoxels(*compute_, *bricks_);
  for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = {i % 2 == 0 ? 1 : 16000, 1};
  test::writeVoxels(*compute_, *bricks_, voxels);
  const LabelCloud::Extract extract = cloud_->extract(bricks, *bricks_, 4);
  ASSERT_EQ(extract.first.size(), bricks.size() + 1);
  const std::vector<cl_uint> labels = test::usedPart(*compute_, *bricks_, bricks_->pools().labels());
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
INSTANTIATE_TEST_SUITE_P(Devices, LabelCloudConfidenceTest, testing::ValuesIn(allDevices()));

}  // namespace
}  // namespace scantrove
