#include "core/scan/scan_run.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/first_error.h"
#include "core/base/overloaded.h"
#include "core/capture/depth_plausibility.h"
#include "core/catalogue/object_database.h"
#include "core/compute/guarded.h"
#include "core/refinement/continued_background.h"
#include "core/scan/scan_opener.h"
#include "core/session/session_setup.h"

namespace scantrove {
namespace {

constexpr int kFramesToFindObject = 30;

Error noObjectFound() {
  return {
      "No object was found near the middle of the image.",
      "Put it there, 0.4 to 1 m from the camera, alone on a flat surface that shows around it, or say where "
      "it is with --object-at."};
}

double peakMemoryMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kilobytes on Linux
}

}  // namespace

Result<std::unique_ptr<ScanRun>> ScanRun::open(const ScanRequest& request, ScanListener listener,
                                               LatestValue<ScanSnapshot>& mailbox,
                                               std::function<void()> on_events) {
  std::unique_ptr<ScanRun> run(new ScanRun(std::move(listener), mailbox));
  SnapshotBuilder& snapshots = run->snapshots_;
  ScanParts& parts = run->parts_;
  SCANTROVE_TRY(moveInto(parts, ScanOpener::open(request, run->listener_, std::move(on_events))));
  run->last_earlier_region_ = parts.pipeline->labels().table().lastRegion();
  run->tally_.emplace(parts.earlier_frames);
  run->advisor_.emplace(parts.request.params.fusion.max_depth_m);
  if (!request.pictures) snapshots.omitPictures();
  run->adviseOnDepthScale();
  if (parts.request.object && !request.refine_session)
    run->object_.emplace(parts.source->info().intrinsics, *parts.request.object);
  snapshots.setLabels({[&parts] { return parts.objects->labels(); },
                       [&parts](SeenObject& seen) { parts.objects->collector().objects().describe(seen); }});
  if (request.refine_session) snapshots.addBricks(parts.pipeline->readout().allBricks());
  return run;
}

Result<ScanRun::Step> ScanRun::step() {
  FrameRead read = next_read_ ? std::move(*std::exchange(next_read_, std::nullopt)) : parts_.source->next();
  tally_->addDropped(read.dropped);
  if (camera_watch_.follow(read, parts_.source->info(), listener_)) parts_.pipeline->camera().interrupt();
  switch (read.status) {
    case FrameRead::Status::end:
      if (parts_.recorder && read.error.what.empty()) parts_.recorder->setMetadata(kReadToEndKey, "yes");
      return Step::end;
    case FrameRead::Status::failed:
      return fail(read.error);
    case FrameRead::Status::timeout:
      applyCatalogueChanges();
      return Step::nothing_yet;
    case FrameRead::Status::skipped:
      SCANTROVE_TRY(skip(read));
      return Step::nothing_yet;
    case FrameRead::Status::frame:
      break;
  }
  if (parts_.takesGivenPoses() && !read.frame.T_world_camera) {
    read.error = {"Frame " + std::to_string(read.frame.index) + " has no usable pose and is left out.", ""};
    SCANTROVE_TRY(skip(read));
    return Step::nothing_yet;
  }
  SCANTROVE_TRY(process(std::move(read.frame)));
  return Step::frame;
}

Result<void> ScanRun::process(RgbdFrame frame) {
  const auto start = std::chrono::steady_clock::now();
  const RgbdFrame whole = frame;
  MappingPipeline::NextFrame next;
  if (object_) {
    frame = object_->apply(whole);  // its mask needs the pose of the frame before, so none is prepared early
  } else {
    next = [this]() -> std::optional<RgbdFrame> {
      next_read_ = parts_.source->nextIfReady();
      if (!next_read_ || next_read_->status != FrameRead::Status::frame) return std::nullopt;
      if (next_read_->is_reconnected) return std::nullopt;  // tracking has to know first
      return next_read_->frame;
    };
  }
  Result<FrameResult> result = parts_.pipeline->processFrame(frame, next);
  if (!result) return fail(result.error());
  if (object_ && result->pose.usable()) object_->follow(result->pose.T_world_camera);
  Result<FrameObjects> objects = parts_.objects->addFrame(frame, *result);
  if (!objects) return fail(objects.error());
  parts_.pipeline->timer().endFrame();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  tally_->addFrameTime(elapsed.count());
  const bool is_usable = result->pose.usable();
  if (const auto drift = tally_->addFrame(*result, frame.index)) listener_(MapDrifted{*drift});
  if (is_usable) parts_.keeps_earlier_scan = false;
  announce(*objects);
  if (!is_usable) applyCatalogueChanges();
  announceMapFailure();
  if (parts_.local_poses != nullptr) parts_.setOrigin(parts_.local_poses->origin());
  if (parts_.output) SCANTROVE_TRY(parts_.output->addFrame(frame, *result));
  if (parts_.recorder) keepFrame(frame, *result);
  result->observed = {};
  result->candidates.clear();
  snapshots_.addFrame(*parts_.pipeline, std::move(frame), std::move(*result), std::move(objects->seen));
  if (const std::optional<Error> advice = advisor_->addFrame(whole, is_usable)) advise(*advice);
  if (object_ && !object_->isFound() && tally_->frames().read == kFramesToFindObject) advise(noObjectFound());
  return restartIfMisled(whole.index);
}

Result<void> ScanRun::skip(const FrameRead& read) {
  tally_->addSkipped();
  listener_(FrameSkipped{read.frame.index, read.error});
  if (!parts_.takesGivenPoses()) return {};
  advisor_->addRefused();
  return restartIfMisled(read.frame.index);
}

Result<void> ScanRun::restartIfMisled(int frame_index) {
  if (!advisor_->isMisled()) return {};
  const bool is_untouched = !parts_.request.resume &&
                            parts_.pipeline->labels().editor().log().entries().empty() &&
                            parts_.objects->collector().objects().list().empty();
  if (!is_untouched) return {};
  const Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(parts_.request.database);
  if (!database) return fail(database.error());
  SCANTROVE_TRY(
      parts_.makeMap(**database, [this](MappingPipeline& given_up) { snapshots_.restart(given_up); }));
  if (object_) object_->restart();
  tally_->restart();
  if (parts_.recorder) parts_.recorder->restart();
  if (parts_.output) parts_.output->restart();
  // Where poses are predictions, a frame that was read ahead keeps the origin.
  if (parts_.takesGivenPoses() && parts_.local_poses != nullptr) parts_.local_poses->forget();
  advise(advisor_->restart(frame_index));
  return {};
}

void ScanRun::advise(const Error& advice) {
  advice_.push_back(advice.message());
  listener_(ScanAdvice{advice});
}

void ScanRun::adviseOnDepthScale() {
  const SourceInfo& info = parts_.source->info();
  if (!info.implausible_depth) return;
  const Error advice = describe(*info.implausible_depth, info.name);
  advice_.push_back(advice.message());
  listener_(ScanAdvice{advice, info.implausible_depth->proposed_units_per_meter});
}

void ScanRun::keepFrame(const RgbdFrame& frame, const FrameResult& result) {
  SessionRecorder& recorder = *parts_.recorder;
  if (!std::exchange(is_recording_noted_, true)) {
    recorder.beginRecording(parts_.request.source, parts_.continued != nullptr ? parts_.continued->shift()
                                                                               : ContinuedSource::Shift{});
  }
  // A later frame may be the first with a pose of the device, and a new map may have another origin.
  if (std::exchange(stored_origin_, parts_.origin_world) != parts_.origin_world)
    recorder.setMetadata(kOriginKey, originToText(parts_.origin_world));
  recorder.addFrame(frame, result);
  keepJoins();
  recorder.saveWhenDue(*parts_.pipeline, parts_.objects->collector());
}

void ScanRun::announce(const FrameObjects& objects) {
  parts_.objects->addMerges(objects.merged);
  for (const ObjectRecord& added : objects.added) listener_(ObjectAdded{added.id, added.name});
  for (const ObjectRecord& known : objects.recognized) listener_(ObjectRecognized{known.id, known.name});
  for (const ObjectId object : objects.new_views) listener_(ViewAdded{object});
  for (const NamedObject& named : objects.named) listener_(ObjectNamed{named.object, named.name});
  for (const ObjectMerge& merge : objects.merged) listener_(ObjectsMerged{merge.into, merge.from});
  for (const ObjectId object : objects.removed) listener_(ObjectRemoved{object});
  if (objects.catalogue_failure) listener_(CatalogueFailed{*objects.catalogue_failure});
}

void ScanRun::announceMapFailure() {
  if (const std::optional<Error> failure = parts_.pipeline->bricks().takeFailure())
    listener_(MapFailed{*failure});
  if (!parts_.recorder) return;
  if (const std::optional<Error> failure = parts_.recorder->takeFailure()) listener_(MapFailed{*failure});
}

bool ScanRun::applyCatalogueChanges() {
  const FrameObjects objects = parts_.objects->collector().applyCatalogueChanges();
  announce(objects);
  return objects.is_catalogue_changed;
}

void ScanRun::setParams(const ScanParams& params) {
  const FusionParams fusion = parts_.request.params.fusion;  // fixed for the life of the map
  const SegmentationParams::Rule rule = parts_.request.params.segmentation.rule;  // of the kind of scan
  parts_.request.params = params;
  parts_.request.params.fusion = fusion;
  parts_.request.params.segmentation.rule = rule;
  parts_.pipeline->setParams(parts_.request.params);
  parts_.objects->collector().setParams(params.detection);
}

Result<RegionEditor::Outcome> ScanRun::doEdit(const ScanEdit& edit) {
  MappingPipeline& pipeline = *parts_.pipeline;
  Result<RegionEditor::Outcome> outcome = std::visit(
      Overloaded{[&](const Operation& operation) { return pipeline.edit(operation); },
                 [&](UndoEdit) { return pipeline.undo(); }, [&](RedoEdit) { return pipeline.redo(); }},
      edit);
  if (!outcome) return outcome;
  parts_.objects->applyEdit(*outcome, std::holds_alternative<UndoEdit>(edit)   ? EditDirection::undone
                                      : std::holds_alternative<RedoEdit>(edit) ? EditDirection::redone
                                                                               : EditDirection::done);
  if (!parts_.recorder) return outcome;
  keepJoins();
  // Reported as done only when stored.
  SCANTROVE_TRY(guarded("keeping the edit",
                        [&] { return parts_.recorder->save(pipeline, &parts_.objects->collector()); }));
  return outcome;
}

void ScanRun::keepJoins() {
  for (const auto& [name, value] : parts_.objects->takeChangedJoins())
    parts_.recorder->setMetadata(name, value);
}

void ScanRun::edit(const ScanEdit& edit) { perform(edit, false); }

void ScanRun::perform(const ScanEdit& edit, bool is_automatic) {
  snapshots_.beginEdit(*parts_.pipeline);
  const Result<RegionEditor::Outcome> outcome = doEdit(edit);
  snapshots_.endEdit(*parts_.pipeline);
  if (outcome) {
    listener_(Edited{edit, outcome->regions, is_automatic});
  } else {
    listener_(EditFailed{edit, outcome.error()});
  }
}

Result<void> ScanRun::segmentAgain() {
  Result<SegmentMap> segments = parts_.pipeline->segmentAgain();
  if (!segments) return fail(segments.error());
  snapshots_.showSegments(std::move(*segments));
  return {};
}

ScanProgress ScanRun::progress(ScanState state) const {
  return {state, tally_->frames(), parts_.source->info().frame_count.value_or(0)};
}

Result<void> ScanRun::showWhenDue(ScanState state) {
  return snapshots_.postWhenDue(*parts_.pipeline, progress(state));
}

Result<void> ScanRun::showNow(ScanState state) { return snapshots_.flush(*parts_.pipeline, progress(state)); }

Result<void> ScanRun::carryBackground() {
  const MapLabels& labels = parts_.pipeline->labels();
  const RegionTable& table = labels.table();
  ContinuedBackground background(
      {table, labels.editor().notes(), labels.editor().log(), parts_.objects->labels()},
      last_earlier_region_);
  if (!background.mayFind()) return {};
  SCANTROVE_TRY(parts_.pipeline->readout().forEachCloudPoint([&](const LabelPoint& point) {
    background.add(table.regionOf(FragmentId{point.fragment}), {point.x, point.y, point.z},
                   {point.normal_x, point.normal_y, point.normal_z});
  }));
  Operation operation;
  operation.kind = OperationKind::background;
  operation.regions = background.find();
  if (!operation.regions.empty()) perform(operation, true);
  return {};
}

void ScanRun::refine(const Ending& ending) {
  if (!parts_.recorder || !hasFrames()) return;
  refinement_.run(parts_, {ending.refines, [&] { ending.enter(ScanState::refining); },
                           [this](const RefinementStepped& step) { listener_(step); },
                           [this](const FrameObjects& objects) { announce(objects); }});
  if (refinement_.report().key_frames > 0) ending.enter(ScanState::finishing);
}

Result<ScanReport> ScanRun::finish(const Ending& ending) {
  stopClock();
  FirstError outcome;
  // Parts that need only this process come first: catalogue or device may fail slowly.
  const bool has_results = parts_.output && !parts_.keeps_earlier_scan;
  if (has_results) outcome.note(parts_.output->writeTrajectory());
  // Before the refinement, which rates the regions that are no background.
  outcome.note(guarded("marking background", [&] { return carryBackground(); }));
  refine(ending);
  outcome.note(guarded("storing what was found", [&] {
    return parts_.objects->finish([this](const FrameObjects& objects) { announce(objects); });
  }));
  if (const auto advice = ScanAdvisor::adviceOn(tally_->frames()); advice && !parts_.request.refine_session)
    advise(*advice);
  ScanReport report;
  outcome.note(guarded("making the report", [&]() -> Result<void> {
    fillReport(report);
    return {};
  }));
  if (parts_.recorder) {
    outcome.note(guarded("keeping the scan", [&] {
      refinement_.keep(parts_);
      if (parts_.output) parts_.recorder->setMetadata(kResultsKey, kResultsCurrent);
      keepJoins();
      return parts_.recorder->finish(*parts_.pipeline, parts_.objects->collector(), parts_.objectness);
    }));
  }
  if (has_results) {
    const auto store = [this](const FinalLabelRecord& record) {
      return parts_.recorder ? parts_.recorder->keepMetadata(kFinalLabelsKey, finalLabelsToText(record))
                             : Result<void>();
    };
    outcome.note(parts_.output->finish(*parts_.pipeline, {parts_.objects->labels(), parts_.objectness},
                                       report, store));
    for (const Error& remark : parts_.output->remarks()) listener_(ScanAdvice{remark});
  }
  announceMapFailure();
  outcome.note(checkResult(report));
  SCANTROVE_TRY(outcome.result());
  return report;
}

void ScanRun::fillReport(ScanReport& report) {
  MappingPipeline& pipeline = *parts_.pipeline;
  report.source = parts_.request.source;
  report.device = parts_.compute->deviceName();
  report.params = parts_.request.params;
  tally_->fill(report);
  report.advice = advice_;
  report.origin_m = parts_.origin_world;
  for (const StageTimer::Stage& stage : pipeline.timer().stages()) {
    const DurationSummary time = summarize(stage.all_ms);
    report.stages.push_back({stage.name, time.median_ms, time.p95_ms});
  }
  constexpr std::size_t kSlowest = 8;
  report.slowest_frames = slowestFrames(pipeline.timer().stages(), kSlowest);
  for (const auto& [name, total_ms] : parts_.compute->kernelTimes()) {
    report.kernels.push_back({name, total_ms / std::max(1, tally_->frames().read)});
  }
  std::sort(report.kernels.begin(), report.kernels.end(),
            [](const auto& a, const auto& b) { return a.mean_ms > b.mean_ms; });
  report.peak_memory_mb = peakMemoryMegabytes();
  report.sensor = parts_.sensor;
  report.map_bricks = pipeline.bricks().brickCount();
  report.map_megabytes = static_cast<double>(pipeline.bricks().device().bytes()) / (1 << 20);
  report.map_disk_megabytes = static_cast<double>(pipeline.bricks().storedBytes()) / (1 << 20);
  const MapReadout::RegionCount regions = pipeline.readout().regionCount();
  report.regions = regions.regions;
  report.small_fragments = regions.small_fragments;
  report.refinement = refinement_.report();
  report.is_of_refinement = parts_.request.refine_session;
  report.objects = ratedObjects();
}

std::vector<CollectedObject> ScanRun::ratedObjects() const {
  const CollectedObjects& objects = parts_.objects->collector().objects();
  std::vector<CollectedObject> list = objects.list();
  for (const auto& [region, objectness] : parts_.objectness) {
    const auto object = std::ranges::find(list, objects.idOf(region), &CollectedObject::id);
    if (object != list.end())
      object->objectness = std::max(object->objectness.value_or(objectness), objectness);
  }
  return list;
}

Result<void> ScanRun::checkResult(const ScanReport& report) const {
  const bool is_empty = tally_->frames().tracked > 0 && report.map_bricks > 0 && parts_.output &&
                        !parts_.keeps_earlier_scan && parts_.output->cloudPoints() == 0;
  if (!is_empty) return {};
  return fail("The scan holds no surface: nothing of what its frames show came into the cloud.",
              "Check the poses, the depth scale (--depth-scale), and fusion.min_depth_m and "
              "fusion.max_depth_m.");
}

}  // namespace scantrove
