#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "core/evaluation/trajectory_metrics.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/scan/scan_objects.h"
#include "core/synthetic/scene_recipe.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/true_surface.h"

namespace scantrove::test {

/// A scan of demo:moving:SEED with Kinect noise, compared with the truth.
struct MovingScan {
  int frames = 0;
  int tracked = 0;
  double rms_m = 0;       ///< of the position error, without alignment
  double ate_m = 0;       ///< absoluteTrajectoryError(): after alignment
  double farthest_m = 0;  ///< largest position error, without alignment
  std::set<std::uint32_t> mug_before,
      mug_after;            ///< objects of the catalogue at the mug, before and after its move
  std::int64_t points = 0;  ///< of the cloud
  std::int64_t ghosts_3cm = 0, ghosts_4cm = 0;  ///< points farther from all surfaces at the end
  std::int64_t of_people = 0;                   ///< of ghosts_3cm: near a former surface of person or arm
  std::int64_t of_moved_objects = 0;            ///< of the rest: near a former surface of mug or chair
};

namespace moving {

// The mug is at rest before this frame.
inline constexpr int kMugIsTaken = 150;
// Mug and chair are at rest from this frame on.
inline constexpr int kAllIsDone = 335;

inline SyntheticOptions optionsFor(std::uint32_t seed, bool noise) {
  SyntheticOptions options;
  options.recipe = [seed] { return synthetic::makeRandomMovingScene(seed); };
  options.noise = noise;
  options.color = noise;
  return options;
}

/// True surfaces: at the end, and of moving objects in all frames.
struct Truth {
  TrueSurface at_the_end, people, moved_objects;
};

inline Truth truthOf(std::uint32_t seed) {
  SyntheticOptions options = optionsFor(seed, false);
  options.stride = 5;
  const auto source = makeSyntheticSource(options).value();
  const auto isOneOf = [&](std::uint16_t id, const char* a, const char* b) {
    return id != 0 && (id == source->scene().find(a) || id == source->scene().find(b));
  };
  Truth truth;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const auto isPerson = [&](std::uint16_t id) { return isOneOf(id, "person", "arm"); };
    const auto isMovedObject = [&](std::uint16_t id) { return isOneOf(id, "mug", "chair"); };
    const bool is_done = read.frame.index >= kAllIsDone;
    truth.at_the_end.add(read.frame, options.K,
                         [&](std::uint16_t id) { return !isPerson(id) && (is_done || !isMovedObject(id)); });
    truth.people.add(read.frame, options.K, isPerson);
    truth.moved_objects.add(read.frame, options.K, isMovedObject);
  }
  return truth;
}

/// Objects of the catalogue whose box overlaps that of the instance by more than 0.6.
inline std::set<std::uint32_t> objectsAt(std::uint16_t instance, const RgbdFrame& frame,
                                         const FrameObjects& objects) {
  std::set<std::uint32_t> found;
  const cv::Rect box = cv::boundingRect(frame.instances == instance);
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

}  // namespace moving

/// Needs a QtMainThread. `frames`: number of frames; 0: all.
inline Result<MovingScan> scanMoving(std::uint32_t seed, ComputeContext& compute, int frames = 0) {
  SyntheticOptions options = moving::optionsFor(seed, true);
  if (frames > 0) options.at_most = frames;
  const auto source = makeSyntheticSource(options);
  if (!source) return fail(source.error());
  const std::uint16_t mug = (*source)->scene().find("mug");
  const TemporaryFolder folder;
  const std::string file = (folder / "catalogue.sqlite").string();
  const auto database = ObjectDatabase::open(file);
  if (!database) return fail(database.error());
  std::unique_ptr<MappingPipeline> pipeline;
  SCANTROVE_TRY(moveInto(pipeline, MappingPipeline::create(compute, {options.K, MappingParams{}})));
  auto collector = ObjectCollector::create(compute, **database, {.database = file}, {});
  if (!collector) return fail(collector.error());
  ScanObjects objects(*pipeline, std::move(*collector));

  MovingScan scan;
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  std::vector<PosePair> poses;
  for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
       read = (*source)->next()) {
    const Result<FrameResult> result = pipeline->processFrame(read.frame);
    if (!result) return fail(result.error());
    const Result<FrameObjects> found = objects.addFrame(read.frame, *result);
    if (!found) return fail(found.error());
    const Eigen::Isometry3d& truth = *read.frame.T_world_camera;
    if (scan.frames == 0) T_world_map = truth;
    if (result->pose.usable()) {
      const double error_m =
          (result->pose.T_world_camera.translation() - (T_world_map.inverse() * truth).translation()).norm();
      scan.farthest_m = std::max(scan.farthest_m, error_m);
      scan.rms_m += error_m * error_m;
      const auto time_s = static_cast<double>(scan.frames);
      poses.push_back({{time_s, result->pose.T_world_camera}, {time_s, truth}});
      ++scan.tracked;
    }
    (scan.frames < moving::kMugIsTaken ? scan.mug_before : scan.mug_after)
        .merge(moving::objectsAt(mug, read.frame, *found));
    ++scan.frames;
  }
  scan.rms_m = std::sqrt(scan.rms_m / std::max(scan.tracked, 1));
  if (poses.size() > 2) scan.ate_m = absoluteTrajectoryError(poses).rmse;

  const moving::Truth truth = moving::truthOf(seed);
  SCANTROVE_TRY(pipeline->readout().forEachCloudPoint([&](const LabelPoint& point) {
    const Eigen::Vector3d p_world = T_world_map * Eigen::Vector3d(point.x, point.y, point.z);
    ++scan.points;
    if (truth.at_the_end.isNear(p_world, 3)) return;
    ++scan.ghosts_3cm;
    if (!truth.at_the_end.isNear(p_world, 4)) ++scan.ghosts_4cm;
    if (truth.people.isNear(p_world, 3)) {
      ++scan.of_people;
    } else if (truth.moved_objects.isNear(p_world, 3)) {
      ++scan.of_moved_objects;
    }
  }));
  return scan;
}

}  // namespace scantrove::test
