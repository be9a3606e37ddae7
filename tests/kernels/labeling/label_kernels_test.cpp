#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/labeling/label_cloud.h"
#include "embedded/labeling_kernels.h"
#include "tests/reference/label_reference.h"
#include "tests/support/brick_contents.h"
#include "tests/support/each_device.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using reference::Voxel;
using test::HostVoxel;
using test::onEachDevice;
using test::onEachWidth;

Eigen::Vector3i voxelIn(const Eigen::Vector3i& brick, int index) {
  return 8 * brick + Eigen::Vector3i(index % 8, index / 8 % 8, index / 64);
}

/// All bricks around the origin, on both sides of each axis.
std::vector<Eigen::Vector3i> bricksAroundOrigin(int reach) {
  std::vector<Eigen::Vector3i> bricks;
  for (int z = -reach; z < reach; ++z) {
    for (int y = -reach; y < reach; ++y) {
      for (int x = -reach; x < reach; ++x) bricks.emplace_back(x, y, z);
    }
  }
  return bricks;
}

/// A map with a unique label in every voxel and various confidences; `labels` are the projected values.
struct LabeledMap {
  LabeledMap(ComputeContext& compute, float voxel_size_m) : bricks(compute, voxel_size_m) {
    bricks.allocate(bricksAroundOrigin(2));
    std::vector<cl_uint> values(static_cast<std::size_t>(bricks.device().slotCapacity()) * BRICK_VOXELS, 0);
    for (int slot = 0; slot < bricks.brickCount(); ++slot) {
      for (int i = 0; i < BRICK_VOXELS; ++i) {
        const auto at = static_cast<std::size_t>(slot) * BRICK_VOXELS + static_cast<std::size_t>(i);
        const auto label = static_cast<std::uint32_t>(at + 1);
        const Eigen::Vector3i voxel = voxelIn(bricks.device().positionOf(slot), i);
        const std::uint32_t confidence = 3 + label % 8;
        labels[{voxel.x(), voxel.y(), voxel.z()}] =
            label | (confidence == LABEL_CONFIDENCE_MAX ? LABEL_SURE : 0);
        values[at] = LABEL_VOXEL(label, confidence);
      }
    }
    voxels = Buffer<cl_uint>(compute.context(), values.size());
    voxels.write(compute.queue(), values);
  }

  BrickMap bricks;
  std::map<Voxel, std::uint32_t> labels;
  Buffer<cl_uint> voxels;
};

std::vector<std::uint32_t> project(ComputeContext& compute, const LabeledMap& map,
                                   const std::vector<Eigen::Vector4f>& vertices) {
  auto kernel = compute.kernel(kernels::labeling, "project_labels");
  EXPECT_TRUE(kernel) << kernel.error().message();
  std::vector<cl_float4> values;
  for (const Eigen::Vector4f& v : vertices) values.push_back({{v.x(), v.y(), v.z(), v.w()}});
  Buffer<cl_float4> input(compute.context(), values.size());
  input.write(compute.queue(), values);
  Buffer<cl_uint> projected(compute.context(), values.size());
  projected.fill(compute.queue(), 12345);
  Buffer<cl_int> stamps(compute.context(), static_cast<std::size_t>(map.bricks.device().slotCapacity()));
  stamps.fill(compute.queue(), LABEL_BRICK_UNUSED);
  const BrickWindow window = test::windowOfAll(compute, map.bricks);
  kernel->launch(cl::NDRange(values.size()), cl::NDRange(64), input, static_cast<cl_int>(values.size()),
                 window.cells(), map.bricks.device().pageSlots(), window.size(), window.first(), map.voxels,
                 stamps, 1.0F / map.bricks.voxelSize(), projected);
  return projected.read(compute.queue());
}

// A power of two, so that voxel borders are exact in float.
constexpr float kExactVoxel_m = 1.0F / 128;

TEST(ProjectLabels, BordersBelongToTheUpperVoxel) {
  onEachWidth([](ComputeContext& compute) {
    const LabeledMap map(compute, kExactVoxel_m);
    std::vector<Eigen::Vector4f> vertices;
    std::vector<std::uint32_t> expected;
    // Quarter-voxel steps along each axis, from beyond the first brick to beyond the last.
    for (int axis = 0; axis < 3; ++axis) {
      for (int quarter = -68; quarter <= 68; ++quarter) {
        Eigen::Vector3f in_voxels(0.25F, -0.25F, 0.5F);
        in_voxels[axis] = 0.25F * static_cast<float>(quarter);
        const Eigen::Vector3f p = in_voxels * kExactVoxel_m;
        vertices.emplace_back(p.x(), p.y(), p.z(), 1.0F);
        expected.push_back(reference::projectedLabel(vertices.back(), kExactVoxel_m, map.labels));
      }
    }
    EXPECT_EQ(project(compute, map, vertices), expected);
    // Explicit expectations: indices are floored, neither rounded nor truncated.
    const auto labelAt = [&](float x) {
      return project(compute, map, {Eigen::Vector4f(x * kExactVoxel_m, 0, 0, 1)})[0];
    };
    EXPECT_EQ(labelAt(0.75F), map.labels.at({0, 0, 0}));
    EXPECT_EQ(labelAt(1.0F), map.labels.at({1, 0, 0}));
    EXPECT_EQ(labelAt(-0.25F), map.labels.at({-1, 0, 0}));
    EXPECT_EQ(labelAt(-1.0F), map.labels.at({-1, 0, 0}));
    EXPECT_EQ(labelAt(-1.25F), map.labels.at({-2, 0, 0}));
  });
}

TEST(ProjectLabels, MatchesTheFormula) {
  onEachWidth([](ComputeContext& compute) {
    constexpr float kVoxel_m = 0.006F;
    const LabeledMap map(compute, kVoxel_m);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> coordinate(-18 * kVoxel_m,
                                                     18 * kVoxel_m);  // bricks end at 16 voxels
    std::vector<Eigen::Vector4f> vertices;
    while (vertices.size() < 5003) {
      const Eigen::Vector3f p(coordinate(random), coordinate(random), coordinate(random));
      const Eigen::Vector3f in_voxels = p / kVoxel_m;
      // Next to a border, rounding of the quotient decides.
      if (((in_voxels.array() - in_voxels.array().round()).abs() < 1e-4F).any()) continue;
      vertices.emplace_back(p.x(), p.y(), p.z(), vertices.size() % 11 == 0 ? 0.0F : 1.0F);
    }
    std::vector<std::uint32_t> expected;
    for (const auto& vertex : vertices) {
      expected.push_back(reference::projectedLabel(vertex, kVoxel_m, map.labels));
    }
    const auto labeled = vertices.size() - static_cast<std::size_t>(std::ranges::count(expected, 0U));
    EXPECT_GT(labeled, vertices.size() / 2);
    EXPECT_LT(labeled, vertices.size() * 9 / 10) << "some lie beyond the bricks";
    EXPECT_EQ(project(compute, map, vertices), expected);
  });
}

TEST(ProjectLabels, GivesNoLabel_WithoutVertex) {
  onEachWidth([](ComputeContext& compute) {
    const LabeledMap map(compute, kExactVoxel_m);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(project(compute, map,
                        {{0, 0, 0, 0}, {0, 0, 0, kNan}, {0.001F, 0.001F, 0.001F, -1}, {0, 0, 65.535F, 1}}),
                testing::Each(0U));
  });
}

TEST(ExtractPoints, MatchesTheFormula_InEveryBrick) {
  onEachDevice([](ComputeContext& compute) {
    constexpr float kVoxel_m = 0.006F;
    BrickMap bricks(compute, kVoxel_m);
    bricks.allocate(bricksAroundOrigin(1));
    auto cloud = LabelCloud::create(compute);
    ASSERT_TRUE(cloud) << cloud.error().message();
    // Distances just below and above the limit for a truncation of 4 voxels, among others.
    const std::vector<int> distances{2, 1, -1, 8191, -8191, 8192, -8192, 16000, 32767, -32767};
    std::mt19937 random(2);
    const auto used = static_cast<std::size_t>(bricks.brickCount()) * BRICK_VOXELS;
    std::vector<HostVoxel> voxels(used);
    std::vector<cl_uint> labels(used, 0);
    for (std::size_t i = 0; i < used; ++i) {
      if (random() % 5 != 0) voxels[i] = {distances[random() % distances.size()], 1};
      const cl_uint label = random() % 3 == 0 ? 0 : static_cast<cl_uint>(random() % LABEL_MAX);
      labels[i] = label == 0 ? 0 : LABEL_VOXEL(label, 1U);
    }
    // One brick has no labels.
    std::fill_n(labels.begin() + 3 * BRICK_VOXELS, BRICK_VOXELS, 0U);
    std::vector<cl_uint> colors(voxels.size());
    for (cl_uint& color : colors) color = static_cast<cl_uint>(random());
    test::writeVoxels(compute, bricks, voxels);
    bricks.pools().labels().write(compute.queue(), labels);
    bricks.pools().colors().write(compute.queue(), colors);

    const std::vector<cl_int> slots{6, 3, 0, 7, 1};
    std::vector<Eigen::Vector3i> listed;
    for (const cl_int slot : slots) listed.push_back(bricks.device().positionOf(slot));
    for (const float truncation_vox : {4.0F, 3.3F}) {
      const LabelCloud::Extract extract = (*cloud)->extract(listed, bricks, truncation_vox);
      ASSERT_EQ(extract.first.size(), slots.size() + 1);
      for (std::size_t b = 0; b < slots.size(); ++b) {
        const auto start = static_cast<std::size_t>(slots[b]) * BRICK_VOXELS;
        const std::vector<reference::SurfacePoint> expected = reference::pointsOfBrick(
            bricks.device().positionOf(slots[b]), double{kVoxel_m}, double{truncation_vox},
            [&](const Eigen::Vector3i& local) {
              const std::size_t i =
                  start + static_cast<std::size_t>(local.x() + 8 * local.y() + 64 * local.z());
              return reference::FusedVoxel{voxels[i].distance / 32767.0, voxels[i].weight > 0,
                                           LABEL_OF(labels[i])};
            });
        ASSERT_EQ(extract.first[b + 1] - extract.first[b], expected.size()) << "slot " << slots[b];
        EXPECT_EQ(expected.empty(), slots[b] == 3);
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const LabelPoint& point = extract.points[extract.first[b] + i];
          EXPECT_EQ(point.fragment, expected[i].fragment);
          EXPECT_FLOAT_EQ(point.x, static_cast<float>(expected[i].center_m.x()));
          EXPECT_FLOAT_EQ(point.y, static_cast<float>(expected[i].center_m.y()));
          EXPECT_FLOAT_EQ(point.z, static_cast<float>(expected[i].center_m.z()));
          EXPECT_NEAR(point.normal_x, expected[i].normal.x(), 1e-5);
          EXPECT_NEAR(point.normal_y, expected[i].normal.y(), 1e-5);
          EXPECT_NEAR(point.normal_z, expected[i].normal.z(), 1e-5);
          if (expected[i].normal.isZero()) {
            EXPECT_EQ(point.height, 0);
          }
          const Eigen::Vector3f in_voxels = Eigen::Vector3f(point.x, point.y, point.z) / kVoxel_m;
          const Eigen::Vector3i local = Eigen::Vector3i(in_voxels.array().floor().cast<int>()) -
                                        8 * bricks.device().positionOf(slots[b]);
          EXPECT_EQ(point.color,
                    colors[start + static_cast<std::size_t>(local.x() + 8 * local.y() + 64 * local.z())]);
        }
      }
    }
    EXPECT_TRUE((*cloud)->extract({}, bricks, 4).points.empty());
    EXPECT_EQ((*cloud)->extract({}, bricks, 4).first, std::vector<std::uint32_t>{0});
    const LabelCloud::Extract of_no_brick =
        (*cloud)->extract(std::vector<Eigen::Vector3i>{{50, 0, 0}}, bricks, 4);
    EXPECT_EQ(of_no_brick.first, (std::vector<std::uint32_t>{0, 0}));
  });
}

TEST(ExtractPoints, GivesEqualPoints_OfSwappedOutBricks) {
  onEachDevice([](ComputeContext& compute) {
    const test::TemporaryFolder folder;
    BrickMap bricks(compute, 0.006F, {64, compute.isCpu(), folder.path()});
    auto cloud = LabelCloud::create(compute);
    ASSERT_TRUE(cloud) << cloud.error().message();
    const std::vector<Eigen::Vector3i> all = bricksAroundOrigin(2);  // in eight pages
    bricks.allocate(all);
    const auto used = static_cast<std::size_t>(bricks.device().slotEnd()) * BRICK_VOXELS;
    std::mt19937 random(4);
    std::vector<HostVoxel> voxels(used);
    std::vector<cl_uint> labels(used);
    for (HostVoxel& voxel : voxels) voxel = {1 + static_cast<int>(random() % 12000), 1};
    for (cl_uint& label : labels) label = LABEL_VOXEL(static_cast<cl_uint>(random() % 40), 1U);
    std::vector<cl_uint> colors(used);
    for (cl_uint& color : colors) color = static_cast<cl_uint>(random());
    test::writeVoxels(compute, bricks, voxels);
    bricks.pools().labels().write(compute.queue(), labels);
    bricks.pools().colors().write(compute.queue(), colors);
    // Bricks of several pages in random order.
    std::vector<Eigen::Vector3i> listed = all;
    std::ranges::shuffle(listed, random);
    listed.resize(40);
    const LabelCloud::Extract before = (*cloud)->extract(listed, bricks, 4);

    bricks.beginFrame({});
    std::vector<Eigen::Vector3i> elsewhere;
    for (int x = 100; x < 120; ++x) elsewhere.emplace_back(x, 0, 0);
    bricks.allocate(elsewhere);  // three pages are swapped out
    ASSERT_NE(bricks.device().slotOf({0, 0, 0}), BRICK_NONE);
    ASSERT_EQ(bricks.device().slotOf({-1, -1, -1}), BRICK_NONE);
    const int resident = bricks.device().brickCount();
    ASSERT_EQ(resident, 60);
    const LabelCloud::Extract after = (*cloud)->extract(listed, bricks, 4);
    EXPECT_EQ(after.first, before.first);
    ASSERT_EQ(after.points.size(), before.points.size());
    EXPECT_GT(after.points.size(), 1000U);
    for (std::size_t i = 0; i < after.points.size(); ++i) {
      ASSERT_EQ(after.points[i].fragment, before.points[i].fragment);
      ASSERT_EQ(after.points[i].x, before.points[i].x);
      ASSERT_EQ(after.points[i].y, before.points[i].y);
      ASSERT_EQ(after.points[i].z, before.points[i].z);
      ASSERT_EQ(after.points[i].color, before.points[i].color);
      ASSERT_EQ(after.points[i].normal_x, before.points[i].normal_x);
      ASSERT_EQ(after.points[i].normal_y, before.points[i].normal_y);
      ASSERT_EQ(after.points[i].normal_z, before.points[i].normal_z);
    }
    EXPECT_EQ(bricks.device().brickCount(), resident) << "extraction swaps no bricks in";
  });
}

}  // namespace
}  // namespace scantrove
