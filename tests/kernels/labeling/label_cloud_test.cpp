#include "core/labeling/label_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "core/compute/device_choice.h"
#include "core/labeling/kernels/label_voxel.h"
#include "tests/reference/dense_label_cloud.h"

namespace scantrove {
namespace {

constexpr float kVoxel = 0.006F;
constexpr int kSide = 152;                    // voxels of the dense volume: 0.912 m
const Eigen::Vector3i kFirst(-76, -76, -40);  // it reaches into negative coordinates on all axes
const Intrinsics kCamera{110, 112, 52.3F, 41.1F, 107, 83};  // odd sizes

/// A sphere in front of a slanted plane, seen from `T`; every 17th pixel has no surface.
std::vector<Eigen::Vector4f> renderScene(const Eigen::Isometry3d& T) {
  const Eigen::Vector3f centre(0.02F, 0.01F, 0.12F);
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
      const Eigen::Vector3f to_centre = centre - origin;
      const float along = to_centre.dot(ray);
      const float miss = to_centre.squaredNorm() - along * along;
      if (miss < radius * radius) distance = std::min(distance, along - std::sqrt(radius * radius - miss));
      const bool none = (u + v * kCamera.width) % 17 == 0 || !(distance > 0);
      const Eigen::Vector3f p = origin + distance * ray;
      vertices.push_back(none ? Eigen::Vector4f::Zero() : Eigen::Vector4f(p.x(), p.y(), p.z(), 1));
    }
  }
  return vertices;
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

  SurfaceMaps toSurface(const std::vector<Eigen::Vector4f>& vertices, const Eigen::Isometry3d& T) {
    SurfaceMaps surface;
    surface.K = kCamera;
    surface.T_world_camera = T;
    surface.vertices_world = Buffer<cl_float4>(compute_->context(), vertices.size());
    std::vector<cl_float4> values;
    for (const auto& v : vertices) values.push_back({{v.x(), v.y(), v.z(), v.w()}});
    surface.vertices_world.write(compute_->queue(), values);
    return surface;
  }

  /// Label of every voxel of the dense volume; counts labelled voxels anywhere.
  std::vector<std::uint32_t> denseLabels(const reference::DenseLabelCloud& shape, std::size_t& labelled) {
    std::vector<std::uint32_t> dense(shape.labels.size(), 0);
    const std::vector<cl_uint> voxels = cloud_->voxels().read(compute_->queue());
    labelled = 0;
    for (int slot = 0; slot < bricks_->brickCount(); ++slot) {
      for (int i = 0; i < BRICK_VOXELS; ++i) {
        const auto at = static_cast<std::size_t>(slot) * BRICK_VOXELS + static_cast<std::size_t>(i);
        const std::uint32_t label = LABEL_OF(voxels[at]);
        if (label == 0) continue;
        ++labelled;
        const Eigen::Vector3i voxel =
            8 * bricks_->positionOf(slot) + Eigen::Vector3i(i % 8, i / 8 % 8, i / 64) - shape.first;
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

RegionMap randomLabels(unsigned seed, LabelTable& table) {
  std::mt19937 random(seed);
  const std::uint32_t first = table.newLabel().value;
  for (int i = 0; i < 20; ++i) (void)table.newLabel();
  RegionMap map{kCamera.width, kCamera.height, {}, {}};
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const bool unlabelled = random() % 29 == 0;
      map.labels.push_back(unlabelled ? 0 : first + static_cast<std::uint32_t>(u / 11 + v / 9) % 20);
    }
  }
  map.regions = map.labels;
  return map;
}

Eigen::Isometry3d cameraAt(double x, double y, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, y, -0.17);
  T.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.13, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return T;
}

TEST_P(LabelCloudTest, EqualsTheLiteralDenseAlgorithmVoxelByVoxelOverSeveralFrames) {
  reference::DenseLabelCloud dense(kFirst, kSide, kVoxel);
  LabelTable table;
  LabelingParams params;
  params.voxel_confidence = false;  // Algorithm 1 overwrites
  for (const float reach_vox : {0.8660254F, 1.0F, 1.7F}) {
    params.update_distance_vox = reach_vox;
    for (int frame = 0; frame < 3; ++frame) {
      const Eigen::Isometry3d T = cameraAt(0.02 * frame, -0.015 * frame, 0.05 * frame);
      const std::vector<Eigen::Vector4f> vertices = renderScene(T);
      const RegionMap merged = randomLabels(static_cast<unsigned>(frame), table);
      (void)cloud_->update(toSurface(vertices, T), merged, table, params, *bricks_);
      dense.update(vertices, merged.labels, kCamera, T, reach_vox * kVoxel);
    }
  }
  std::size_t labelled = 0;
  const std::vector<std::uint32_t> sparse = denseLabels(dense, labelled);
  // Kernel and reference round alike but may contract multiply-adds differently: a voxel that projects within
  // an ulp of a pixel's border may take the neighbour. Among 10^5 labelled voxels that is a handful at most.
  std::size_t different = 0;
  std::size_t expected = 0;
  for (std::size_t i = 0; i < sparse.size(); ++i) {
    different += sparse[i] != dense.labels[i] ? 1U : 0U;
    expected += dense.labels[i] != 0 ? 1U : 0U;
  }
  EXPECT_GT(expected, 10000U);
  EXPECT_LE(different, expected / 20000);
  EXPECT_EQ(labelled, expected)
      << "a voxel outside of the dense volume was labelled, or the volume is too small";
}

TEST_P(LabelCloudTest, ProjectionReadsBackWhatWasWrittenAtEachVertex) {
  LabelTable table;
  LabelingParams params;
  params.voxel_confidence = false;
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const std::vector<Eigen::Vector4f> vertices = renderScene(T);
  const SurfaceMaps surface = toSurface(vertices, T);
  EXPECT_THAT(cloud_->project(surface, *bricks_), testing::Each(0U));
  RegionMap merged{kCamera.width, kCamera.height, {}, {}};
  for (int i = 0; i < kCamera.pixels(); ++i) merged.labels.push_back(table.newLabel().value);
  (void)cloud_->update(surface, merged, table, params, *bricks_);
  reference::DenseLabelCloud dense(kFirst, kSide, kVoxel);
  dense.update(vertices, merged.labels, kCamera, T, params.update_distance_vox * kVoxel);
  const std::vector<std::uint32_t> projected = cloud_->project(surface, *bricks_);
  std::size_t labelled = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].w() == 0) {
      EXPECT_EQ(projected[i], 0U);
      continue;
    }
    const Eigen::Vector3d in_voxels = vertices[i].head<3>().cast<double>() / double{kVoxel};
    const Eigen::Vector3i voxel = in_voxels.array().floor().cast<int>().matrix() - kFirst;
    const std::uint32_t expected = dense.labels[dense.indexOf(voxel.x(), voxel.y(), voxel.z())];
    labelled += expected != 0 ? 1U : 0U;
    different += projected[i] != expected ? 1U : 0U;
  }
  // The voxel of a vertex may itself be seen through a neighbouring pixel without surface, or lie outside the
  // image: it has no label then.
  EXPECT_GT(labelled, vertices.size() * 8 / 10);
  // Vertices and centres within an ulp of a border, as above.
  EXPECT_LE(different, labelled / 1000);
}

TEST_P(LabelCloudTest, ConfidenceKeepsALabelAgainstFewerDisagreements) {
  LabelTable table;
  const RegionId first = table.newLabel();
  const RegionId second = table.newLabel();
  LabelingParams params;
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const SurfaceMaps surface = toSurface(renderScene(T), T);
  RegionMap merged{kCamera.width, kCamera.height, {}, {}};
  const auto write = [&](RegionId region, int times) {
    merged.labels.assign(static_cast<std::size_t>(kCamera.pixels()), region.value);
    for (int i = 0; i < times; ++i) (void)cloud_->update(surface, merged, table, params, *bricks_);
  };
  const auto held = [&] {
    std::size_t labelled = 0;
    std::set<std::uint32_t> labels;
    for (const std::uint32_t label :
         denseLabels(reference::DenseLabelCloud(kFirst, kSide, kVoxel), labelled)) {
      if (label != 0) labels.insert(label);
    }
    return labels;
  };
  write(first, 3);
  write(second, 2);
  EXPECT_EQ(held(), std::set<std::uint32_t>{first.value});
  write(second, 1);
  EXPECT_EQ(held(), std::set<std::uint32_t>{second.value});
  // Labels of one region agree whatever their numbers: the voxel keeps its own.
  table.join(first, second);
  write(first, 4);
  EXPECT_EQ(held(), std::set<std::uint32_t>{second.value});
}

TEST_P(LabelCloudTest, EmptyFrameTouchesNothing) {
  LabelTable table;
  const SurfaceMaps surface = toSurface(
      std::vector<Eigen::Vector4f>(static_cast<std::size_t>(kCamera.pixels()), Eigen::Vector4f::Zero()),
      Eigen::Isometry3d::Identity());
  EXPECT_TRUE(cloud_->update(surface, randomLabels(1, table), table, {}, *bricks_).empty());
  EXPECT_EQ(bricks_->brickCount(), 0);
}

TEST_P(LabelCloudTest, ExtractGivesEachBrickItsOwnNearSurfaceVoxels) {
  LabelTable table;
  const Eigen::Isometry3d T = cameraAt(0, 0, 0);
  const SurfaceMaps surface = toSurface(renderScene(T), T);
  const RegionMap merged = randomLabels(1, table);
  const auto touched = cloud_->update(surface, merged, table, {}, *bricks_);
  const std::vector<cl_int> slots(touched.begin(), touched.end());
  EXPECT_TRUE(cloud_->extract(slots, *bricks_, 4).points.empty())
      << "nothing was fused, so nothing has a surface";
  // Every second voxel lies on the surface, the others half a truncation away.
  std::vector<TsdfVoxel> voxels(bricks_->voxels().size());
  for (std::size_t i = 0; i < voxels.size(); ++i)
    voxels[i] = {static_cast<cl_short>(i % 2 == 0 ? 0 : 16000), 256};
  bricks_->voxels().write(compute_->queue(), voxels);
  const LabelCloud::Extract extract = cloud_->extract(slots, *bricks_, 4);
  ASSERT_EQ(extract.first.size(), slots.size() + 1);
  const std::vector<cl_uint> labels = cloud_->voxels().read(compute_->queue());
  for (std::size_t b = 0; b < slots.size(); ++b) {
    std::size_t expected = 0;
    for (std::size_t i = 0; i < BRICK_VOXELS; i += 2) {
      expected += LABEL_OF(labels[static_cast<std::size_t>(slots[b]) * BRICK_VOXELS + i]) != 0 ? 1U : 0U;
    }
    ASSERT_EQ(extract.first[b + 1] - extract.first[b], expected);
    for (std::uint32_t p = extract.first[b]; p < extract.first[b + 1]; ++p) {
      const LabelPoint& point = extract.points[p];
      const Eigen::Vector3f in_bricks = Eigen::Vector3f(point.x, point.y, point.z) / (8 * kVoxel);
      EXPECT_EQ(Eigen::Vector3i(in_bricks.array().floor().cast<int>()), bricks_->positionOf(slots[b]));
      EXPECT_NE(point.label, 0U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, LabelCloudTest, testing::ValuesIn(allDevices()));

}  // namespace
}  // namespace scantrove
