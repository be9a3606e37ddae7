#include <gtest/gtest.h>

#include <array>
#include <set>

#include "tests/kernels/labeling/label_cloud_fixture.h"

namespace scantrove::test {
namespace {

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
    std::vector<cl_uint> voxels = usedPart(*compute_, *bricks_, bricks_->pools().labels());
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
    const std::vector<cl_uint> voxels = usedPart(*compute_, *bricks_, bricks_->pools().labels());
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

INSTANTIATE_TEST_SUITE_P(Devices, LabelCloudConfidenceTest, testing::ValuesIn(allDevices()));

}  // namespace
}  // namespace scantrove::test
