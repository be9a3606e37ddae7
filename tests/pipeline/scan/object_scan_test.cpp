#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "core/pipeline/mapping_pipeline.h"
#include "core/pipeline/object_mask.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {
namespace {

// A thing on a turntable, scanned alone: half a turn in steps of 3 degrees.
TEST(ObjectScan, FollowsTheThing_AndMapsNothingElse) {
  SyntheticOptions options;
  options.recipe = [] { return synthetic::makeRandomTurntableScene(3); };
  options.stride = 2;
  options.at_most = 60;
  const auto source = makeSyntheticSource(options).value();
  const auto at_rest = makeSyntheticSource(options).value();  // the scene before the turn
  const Eigen::AlignedBox3d thing = at_rest->scene().boundsOf(at_rest->scene().find("thing"));
  const Eigen::Isometry3d T_thing_map = source->pose(0);  // the map begins at the first camera

  const auto compute = ComputeContext::create({}).value();
  MappingParams params;
  params.fusion.voxel_size_m = 0.003F;
  params.segmentation.rule = SegmentationParams::Rule::whole;
  MappingPipeline::Setup setup{source->info().intrinsics, params};
  setup.filled_part = 0.12;
  const auto pipeline = MappingPipeline::create(*compute, setup).value();
  ObjectMask object(source->info().intrinsics, {});
  int usable = 0;
  double worst_m = 0, worst_rad = 0;
  std::set<std::uint32_t> regions;
  FrameResult last;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    Result<FrameResult> result = pipeline->processFrame(object.apply(read.frame));
    ASSERT_TRUE(result) << result.error().message();
    if (!result->pose.usable()) continue;
    ++usable;
    object.follow(result->pose.T_world_camera);
    const Eigen::Isometry3d error =
        (T_thing_map * result->pose.T_world_camera).inverse() * source->pose(read.frame.index);
    worst_m = std::max(worst_m, error.translation().norm());
    worst_rad = std::max(worst_rad, Eigen::AngleAxisd(error.linear()).angle());
    for (const RegionId region : result->view.regions)
      if (region) regions.insert(region.value);
    last = std::move(*result);
  }
  EXPECT_EQ(usable, 60);
  EXPECT_LE(worst_m, 0.01);
  EXPECT_LE(worst_rad, 2 * std::numbers::pi / 180);
  EXPECT_EQ(regions.size(), 1U) << "the object is one region";
  ASSERT_EQ(last.candidates.size(), 1U);
  EXPECT_TRUE(last.candidates.front().is_complete);
  int surface = 0, beside = 0;
  for (const Eigen::Vector4f& vertex : last.view.vertices_world) {
    if (!(vertex.w() > 0)) continue;
    ++surface;
    const Eigen::Vector3d at = T_thing_map * vertex.head<3>().cast<double>();
    beside += thing.exteriorDistance(at) > 0.015 ? 1 : 0;
  }
  EXPECT_GT(surface, 1000);
  EXPECT_LE(beside, surface / 200) << "nothing of the table or the room is in the map";
}

}  // namespace
}  // namespace scantrove::test
