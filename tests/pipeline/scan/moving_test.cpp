#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/scan/scan_pipeline.h"
#include "core/synthetic/film_set.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/true_surface.h"

namespace scantrove::test {
namespace {

SyntheticOptions moving(bool noise) {
  SyntheticOptions options;
  options.set = [] { return synthetic::makeRandomMovingSet(2); };
  options.noise = noise;
  options.color = noise;
  return options;
}

// Before that frame the mug stands where it stood.
constexpr int kMugIsTaken = 150;
// Mug and chair are at rest from then on.
constexpr int kAllIsDone = 335;

TrueSurface whatIsThereAtTheEnd() {
  SyntheticOptions options = moving(false);
  options.stride = 15;
  const auto source = makeSyntheticSource(options).value();
  const auto id = [&](const char* name) { return source->scene().find(name); };
  TrueSurface surface;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const bool is_done = read.frame.index >= kAllIsDone;
    surface.add(read.frame, options.K, [&](std::uint16_t who) {
      return who != id("walker") && who != id("arm") && (is_done || (who != id("mug") && who != id("chair")));
    });
  }
  return surface;
}

/// The objects of the catalogue that are seen where the frame shows the thing.
std::set<std::uint32_t> objectsAt(std::uint16_t thing, const RgbdFrame& frame, const FrameObjects& objects) {
  std::set<std::uint32_t> found;
  const cv::Rect box = cv::boundingRect(frame.instances == thing);
  const auto width = static_cast<float>(frame.color.cols), height = static_cast<float>(frame.color.rows);
  for (const SeenObject& seen : objects.seen) {
    const cv::Rect2f seen_box(seen.box.x * width, seen.box.y * height, seen.box.width * width,
                              seen.box.height * height);
    const float both = (seen_box & cv::Rect2f(box)).area();
    const float either = seen_box.area() + static_cast<float>(box.area()) - both;
    if (seen.object && both > 0.6F * either) found.insert(seen.object.value);
  }
  return found;
}

TEST(MovingScene, LeavesNoGhostsDoesNotPullTheCameraAndKnowsTheMugWhereItIsPut) {
  const SyntheticOptions options = moving(true);
  const auto source = makeSyntheticSource(options).value();
  const std::uint16_t mug = source->scene().find("mug");
  const auto compute = ComputeContext::create({}).value();
  const QtMainThread qt;
  const TemporaryFolder folder;
  const std::string file = (folder / "catalogue.sqlite").string();
  const auto database = ObjectDatabase::open(file).value();
  ScanPipeline::Setup setup{options.K, ScanParams{}};
  setup.database = database.get();
  setup.catalogue.database = file;
  const auto pipeline = ScanPipeline::create(*compute, setup).value();
  std::set<std::uint32_t> mug_before, mug_after;
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  double squares = 0, farthest_m = 0;
  int frames = 0;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const Result<FrameResult> result = pipeline->processFrame(read.frame);
    ASSERT_TRUE(result) << result.error().message();
    if (frames == 0) T_world_map = *read.frame.T_world_camera;
    ASSERT_EQ(result->pose.state, TrackingState::tracking) << read.frame.index;
    const Eigen::Vector3d truth = (T_world_map.inverse() * *read.frame.T_world_camera).translation();
    const double off_m = (result->pose.T_world_camera.translation() - truth).norm();
    farthest_m = std::max(farthest_m, off_m);
    squares += off_m * off_m;
    (frames < kMugIsTaken ? mug_before : mug_after).merge(objectsAt(mug, read.frame, result->objects));
    ++frames;
  }
  EXPECT_EQ(frames, 420);
  EXPECT_EQ(mug_before.size(), 1U);
  EXPECT_EQ(mug_after, mug_before);
  // Not aligned: the ATE would be less. Without the motion filter somebody's way past the camera took it
  // along for up to 180 mm.
  EXPECT_LT(std::sqrt(squares / frames), 0.015);
  EXPECT_LT(farthest_m, 0.040);

  const TrueSurface truth = whatIsThereAtTheEnd();
  std::int64_t points = 0, ghosts = 0;
  const Result<void> read = pipeline->forEachCloudPoint([&](const LabelPoint& point) {
    ++points;
    if (!truth.isNear(T_world_map * Eigen::Vector3d(point.x, point.y, point.z), 4)) ++ghosts;
  });
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_GT(points, 300000);
  EXPECT_LT(static_cast<double>(ghosts), 0.001 * static_cast<double>(points)) << ghosts << " ghosts";
}

}  // namespace
}  // namespace scantrove::test
