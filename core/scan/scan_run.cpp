#include "core/scan/scan_run.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "core/base/heap.h"
#include "core/base/overloaded.h"
#include "core/catalogue/object_database.h"
#include "core/collection/collector_memory.h"
#include "core/compute/guarded.h"
#include "core/scan/catalogue_numbers.h"
#include "core/scan/final_pass.h"
#include "core/scan/no_frames.h"
#include "core/scan/open_session.h"
#include "core/scan/open_source.h"
#include "core/scan/output_owner.h"
#include "core/scan/session_restorer.h"
#include "core/scan/session_setup.h"

namespace scantrove {
namespace {

double peakMemoryMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kilobytes on Linux
}

/// By then all kernels that frames need are built.
constexpr std::size_t kFramesUntilBuilt = 20;

/// The same pixels, and within a hundredth the same lens.
bool isSameCamera(const Intrinsics& a, const Intrinsics& b) {
  const auto isNear = [](float x, float y, float scale) { return std::abs(x - y) <= 0.01F * scale; };
  return a.width == b.width && a.height == b.height && isNear(a.fx, b.fx, a.fx) && isNear(a.fy, b.fy, a.fy) &&
         isNear(a.cx, b.cx, a.fx) && isNear(a.cy, b.cy, a.fy);
}

/// Landmarks tell where they are to a few centimetres.
constexpr double kReportedDrift_m = 0.10;
constexpr double kClearlyWorse = 1.5;

Error hasDrifted(double drift_m, int frame_index) {
  return {"In frame " + std::to_string(frame_index) + " the camera is back at a place, and the map has it " +
              std::to_string(std::lround(drift_m * 100)) +
              " cm beside where it was: what is seen there now is in the map twice.",
          "Scan shorter rounds, and slowly where there is little to see."};
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Result<std::unique_ptr<ScanRun>> ScanRun::open(const ScanRequest& request, ScanListener listener,
                                               LatestValue<ScanSnapshot>& mailbox,
                                               std::function<void()> on_news) {
  std::unique_ptr<ScanRun> run(new ScanRun(request, std::move(listener), mailbox));
  if (!request.pictures) run->snapshots_.omitPictures();
  SCANTROVE_TRY(run->checkFolder());
  SCANTROVE_TRY(run->openFrames());
  const SourceInfo& info = run->source_->info();
  if (run->request_.poses == ScanRequest::Poses::given && !info.has_poses) {
    return fail("The recording " + info.name + " (" + info.kind + ") has no poses.",
                "Leave out --poses given.");
  }
  SCANTROVE_TRY(moveInto(run->compute_, ComputeContext::create({.device = request.device,
                                                                .profiling = request.profile_kernels,
                                                                .on_compiling = [run = run.get()] {
                                                                  run->listener_(PreparingDevice{});
                                                                }})));
  if (request.output_folder && run->request_.results) {
    SCANTROVE_TRY(moveInto(run->output_, ScanOutput::create(*request.output_folder, request.label_maps)));
    run->output_->setOrigin(run->origin_world_);
  }
  SCANTROVE_TRY(run->openSession(info));
  const bool takes_poses = run->request_.poses == ScanRequest::Poses::given && !request.refine_session;
  if (takes_poses) run->takePoses();
  run->on_news_ = std::move(on_news);
  SCANTROVE_TRY(run->makePipeline());
  return run;
}

Result<void> ScanRun::openFrames() {
  if (request_.refine_session) return openSessionToRefine();
  return moveInto(source_, openSource(request_.source, request_.source_options));
}

Result<void> ScanRun::openSessionToRefine() {
  const std::filesystem::path& folder = *request_.output_folder;
  SCANTROVE_TRY(moveInto(session_, SessionWriter::start(folder, SessionWriter::Way::open)));
  std::vector<std::string> damages;
  SCANTROVE_TRY(loadEarlier(damages));
  for (const std::string& damage : damages) listener_(MapFailed{{damage, ""}});
  const Result<SessionSetup> setup = setupFrom(earlier_->metadata);
  if (!setup) return fail(setup.error());
  request_.source = setup->source;
  request_.params = setup->params;
  // A scan of the window has a session alone.
  request_.results = holdsOurResults(folder);
  origin_world_ = setup->origin_m;
  request_.database = databaseFileOf(*setup, folder).string();
  std::error_code ignored;
  if (!std::filesystem::exists(request_.database, ignored)) {
    return fail("The catalogue " + request_.database + " of the scan " + folder.string() + " is not there.",
                "Put it back, then refine the scan.");
  }
  // Nothing is tracked any more.
  request_.poses = ScanRequest::Poses::given;
  for (const SavedFrame& frame : earlier_->frames) {
    ++frames_.read;
    ++(frame.isUsable() ? frames_.tracked : frames_.lost);
  }
  SourceInfo info;
  info.name = setup->source;
  info.kind = "session";
  info.intrinsics = setup->K;
  info.frame_count = frames_.read;
  info.has_poses = true;
  source_ = std::make_unique<NoFrames>(std::move(info));
  if (auto memory = refinementMemoryFrom(earlier_->metadata, earlier_->operations))
    refinement_memory_ = std::move(*memory);
  return {};
}

Result<void> ScanRun::makePipeline() {
  const std::string& file = request_.database;
  const Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(file);
  if (!database) return fail(database.error());
  SCANTROVE_TRY(moveInto(catalogue_, (*database)->identity()));
  if (recorder_) recorder_->setCatalogue(catalogue_);
  if (request_.refine_session && isOfAnotherCatalogue())
    return fail(isAnotherCatalogue(*request_.output_folder, file));
  SCANTROVE_TRY(createPipeline(**database));
  return resumeSession(**database);
}

bool ScanRun::isOfAnotherCatalogue() const {
  const auto own = earlier_->metadata.find(kCatalogueKey);
  return own != earlier_->metadata.end() && !own->second.empty() && own->second != catalogue_;
}

Result<void> ScanRun::checkFolder() const {
  if (!request_.output_folder || request_.refine_session || request_.overwrite) return {};
  const PlannedResults planned{request_.results, request_.results && request_.label_maps};
  return request_.resume ? checkResultsAreOurs(*request_.output_folder, planned)
                         : checkHoldsOnlyOurs(*request_.output_folder, planned);
}

Result<void> ScanRun::createPipeline(ObjectDatabase& database) {
  const SourceInfo& info = source_->info();
  CatalogueWriter::Options catalogue;
  catalogue.database = request_.database;
  catalogue.source = info.name;
  catalogue.camera = info.intrinsics;
  catalogue.on_news = on_news_;
  catalogue.patience = request_.catalogue_patience;
  std::unique_ptr<ScanPipeline> pipeline;
  SCANTROVE_TRY(moveInto(
      pipeline,
      ScanPipeline::create(*compute_, {info.intrinsics, request_.params,
                                       request_.poses == ScanRequest::Poses::given, info.frame_count})));
  std::unique_ptr<ObjectCollector> collector;
  SCANTROVE_TRY(
      moveInto(collector, ObjectCollector::create(*compute_, database, catalogue, request_.params.detection,
                                                  refinement_memory_.collector)));
  if (pipeline_) snapshots_.beginAnew(*pipeline_);
  objects_ = std::make_unique<ScanObjects>(*pipeline, std::move(collector));
  pipeline_ = std::move(pipeline);
  snapshots_.setLabels({[this] { return objects_->labels(); },
                        [this](SeenObject& seen) { objects_->collector().objects().describe(seen); }});
  return {};
}

Result<void> ScanRun::openSession(const SourceInfo& info) {
  if (!request_.output_folder || request_.refine_session) return {};
  const std::filesystem::path& folder = *request_.output_folder;
  keeps_earlier_scan_ = !request_.resume && holdsEarlierScan(folder);
  if (!request_.session) return {};
  if (request_.resume) {
    SCANTROVE_TRY(moveInto(session_, SessionWriter::start(folder, SessionWriter::Way::open)));
    return readSession(info);
  }
  SCANTROVE_TRY(beginSession(info));
  return checkFolder();  // once more, now that nobody else can begin there
}

Result<void> ScanRun::beginSession(const SourceInfo& info) {
  SCANTROVE_TRY(
      moveInto(session_, SessionWriter::start(*request_.output_folder, SessionWriter::Way::create)));
  SessionRecorder::Setup setup{.all_frames = request_.record_all};
  setup.metadata = metadataOf({request_.source, info.intrinsics, request_.params,
                               storedDatabaseName(request_.database, *request_.output_folder)});
  setup.metadata.merge(refinementMetadata(false));
  if (output_) setup.metadata[kResultsKey] = kResultsBegun;
  if (output_ && request_.label_maps) setup.metadata[kLabelImagesKey] = "yes";
  recorder_ = std::make_unique<SessionRecorder>(std::move(session_), std::move(setup));
  if (!catalogue_.empty()) recorder_->setCatalogue(catalogue_);
  return {};
}

Result<void> ScanRun::readSession(const SourceInfo& info) {
  std::vector<std::string> damages;
  SCANTROVE_TRY(loadEarlier(damages));
  const Result<SessionSetup> setup = setupFrom(earlier_->metadata);
  if (!setup) return fail(setup.error());
  if (!isSameCamera(setup->K, info.intrinsics)) {
    return fail("The session " + request_.output_folder->string() +
                    " was scanned with another camera than that of " + info.name + ".",
                "Scan into a folder of its own.");
  }
  request_.params.fusion = setup->params.fusion;
  setOrigin(setup->origin_m);
  if (request_.database.empty()) {
    std::filesystem::path file = databaseFileOf(*setup, *request_.output_folder);
    std::error_code ignored;
    // Of a session that was taken elsewhere without it.
    if (!std::filesystem::exists(file, ignored)) file = *request_.output_folder / "catalogue.sqlite";
    request_.database = file.string();
  }
  for (const std::string& damage : damages) listener_(MapFailed{{damage, ""}});
  return {};
}

Result<void> ScanRun::loadEarlier(std::vector<std::string>& damages) {
  SCANTROVE_TRY(moveInto(earlier_, loadScan(*session_, damages)));
  const auto pending = earlier_->metadata.find(kPendingEditsKey);
  if (pending == earlier_->metadata.end() || pending->second.empty()) return {};
  const std::filesystem::path folder = session_->folder();
  session_.reset();  // for one at a time
  // Opening it does that. What cannot be done by now waits on.
  if (const auto opened = OpenSession::open(folder, request_.device); !opened) return fail(opened.error());
  SCANTROVE_TRY(moveInto(session_, SessionWriter::start(folder, SessionWriter::Way::open)));
  return moveInto(earlier_, loadScan(*session_, damages));
}

ScanRun::~ScanRun() = default;

Result<ScanRun::Step> ScanRun::step() {
  FrameRead read = next_read_ ? std::move(*std::exchange(next_read_, std::nullopt)) : source_->next();
  frames_.dropped += read.dropped;
  switch (read.status) {
    case FrameRead::Status::end:
      return Step::end;
    case FrameRead::Status::failed:
      return fail(read.error);
    case FrameRead::Status::timeout:
      followCatalogue();
      return Step::nothing_yet;
    case FrameRead::Status::skipped:
      SCANTROVE_TRY(skip(read));
      return Step::nothing_yet;
    case FrameRead::Status::frame:
      break;
  }
  if (request_.poses == ScanRequest::Poses::given && !read.frame.T_world_camera) {
    read.error = {"Frame " + std::to_string(read.frame.index) + " has no usable pose and is left out.", ""};
    SCANTROVE_TRY(skip(read));
    return Step::nothing_yet;
  }
  SCANTROVE_TRY(process(std::move(read.frame)));
  return Step::frame;
}

Result<void> ScanRun::process(RgbdFrame frame) {
  const auto start = std::chrono::steady_clock::now();
  Result<FrameResult> result = pipeline_->processFrame(frame, [this]() -> std::optional<RgbdFrame> {
    next_read_ = source_->nextIfReady();
    if (!next_read_ || next_read_->status != FrameRead::Status::frame) return std::nullopt;
    return next_read_->frame;
  });
  if (!result) return fail(result.error());
  Result<FrameObjects> objects = objects_->addFrame(frame, *result);
  if (!objects) return fail(objects.error());
  pipeline_->timer().endFrame();
  frame_ms_.push_back(millisecondsSince(start));
  if (frame_ms_.size() == kFramesUntilBuilt) trimHeap();
  count(*result, frame.index);
  if (result->pose.usable()) keeps_earlier_scan_ = false;
  announce(*objects);
  if (!result->pose.usable()) followCatalogue();
  announceMapFailure();
  if (local_poses_ != nullptr) setOrigin(local_poses_->origin());
  if (output_) SCANTROVE_TRY(output_->addFrame(frame, *result));
  if (recorder_) keepFrame(frame, *result);
  const RgbdFrame shown = frame;
  const bool is_usable = result->pose.usable();
  result->observed = {};
  result->candidates.clear();
  snapshots_.addFrame(*pipeline_, std::move(frame), std::move(*result), std::move(objects->seen));
  return followAdvisor(shown, is_usable);
}

Result<void> ScanRun::skip(const FrameRead& read) {
  ++frames_.skipped;
  listener_(FrameSkipped{read.frame.index, read.error});
  if (local_poses_ == nullptr) return {};
  advisor_.addRefused();
  return advisor_.isMisled() && isUntouched() ? beginAnew(read.frame.index) : Result<void>();
}

void ScanRun::count(const FrameResult& result, int frame_index) {
  ++frames_.read;
  for (const LateFrame& late : result.late) {
    --frames_.lost;
    ++frames_.tracked;
    std::erase(lost_frames_, late.index);
    if (first_usable_.size() < ScanAdvisor::kRememberedFrames) first_usable_.push_back(late.index);
  }
  if (!result.pose.usable()) {
    ++frames_.lost;
    lost_frames_.push_back(frame_index);
    return;
  }
  ++frames_.tracked;
  if (first_usable_.size() < ScanAdvisor::kRememberedFrames) first_usable_.push_back(frame_index);
  if (result.pose.state == TrackingState::relocalized) ++frames_.relocalized;
  measureDrift(result, frame_index);
}

void ScanRun::measureDrift(const FrameResult& result, int frame_index) {
  if (result.pose.drift_m) {
    ++drift_.corrected_frames;
    drift_.most_corrected_m = std::max(drift_.most_corrected_m, *result.pose.drift_m);
  }
  if (!result.returned) return;
  ++drift_.revisited_key_frames;
  // Told once, and again when it has become clearly worse.
  const double drift_m = result.returned->drift_m;
  if (drift_m > kReportedDrift_m && drift_m > kClearlyWorse * drift_.most_m)
    listener_(MapDrifted{hasDrifted(drift_m, frame_index)});
  drift_.most_m = std::max(drift_.most_m, drift_m);
}

void ScanRun::announce(const FrameObjects& objects) {
  for (const ObjectRecord& added : objects.added) listener_(ObjectAdded{added.id, added.name});
  for (const ObjectRecord& known : objects.recognized) listener_(ObjectRecognized{known.id, known.name});
  for (const ObjectId object : objects.new_views) listener_(ViewAdded{object});
  for (const NamedObject& named : objects.named) listener_(ObjectNamed{named.object, named.name});
  for (const ObjectMerge& merge : objects.merged) listener_(ObjectsMerged{merge.into, merge.from});
  for (const ObjectId object : objects.left) listener_(ObjectLeft{object});
  if (objects.catalogue_failure) listener_(CatalogueFailed{*objects.catalogue_failure});
}

void ScanRun::announceMapFailure() {
  if (const std::optional<Error> failure = pipeline_->takeMapFailure()) listener_(MapFailed{*failure});
  if (!recorder_) return;
  if (const std::optional<Error> failure = recorder_->takeFailure()) listener_(MapFailed{*failure});
}

bool ScanRun::followCatalogue() {
  const FrameObjects objects = objects_->collector().followCatalogue();
  announce(objects);
  return objects.has_news;
}

Result<RegionEditor::Outcome> ScanRun::doEdit(const ScanEdit& edit) {
  Result<RegionEditor::Outcome> outcome = std::visit(
      Overloaded{[&](const Operation& operation) { return pipeline_->edit(operation); },
                 [&](UndoEdit) { return pipeline_->undo(); }, [&](RedoEdit) { return pipeline_->redo(); }},
      edit);
  if (!outcome) return outcome;
  const ScanObjects::Edit what = std::holds_alternative<UndoEdit>(edit)   ? ScanObjects::Edit::undone
                                 : std::holds_alternative<RedoEdit>(edit) ? ScanObjects::Edit::redone
                                                                          : ScanObjects::Edit::done;
  objects_->follow(*outcome, what);
  // It is not said to be done before it is safe.
  if (recorder_) SCANTROVE_TRY(guarded("keeping the edit", [&] { return save(); }));
  return outcome;
}

Result<void> ScanRun::save() { return recorder_->save(*pipeline_, &objects_->collector()); }

void ScanRun::setParams(const ScanParams& params) {
  pipeline_->setParams(params);
  objects_->collector().setParams(params.detection);
}

void ScanRun::edit(const ScanEdit& edit) {
  snapshots_.beginEdit(*pipeline_);
  const Result<RegionEditor::Outcome> outcome = doEdit(edit);
  snapshots_.endEdit(*pipeline_);
  if (outcome) {
    listener_(Edited{edit, outcome->regions});
  } else {
    listener_(EditFailed{edit, outcome.error()});
  }
}

Result<void> ScanRun::segmentAgain() {
  Result<SegmentMap> segments = pipeline_->segmentAgain();
  if (!segments) return fail(segments.error());
  snapshots_.showSegments(std::move(*segments));
  return {};
}

ScanProgress ScanRun::progress(ScanState state) const {
  return {state, frames_, source_->info().frame_count.value_or(0)};
}

Result<void> ScanRun::showWhenDue(ScanState state) {
  return snapshots_.postWhenDue(*pipeline_, progress(state));
}

Result<void> ScanRun::showNow(ScanState state) { return snapshots_.flush(*pipeline_, progress(state)); }

void ScanRun::startClock() {
  if (!clock_start_) clock_start_ = std::chrono::steady_clock::now();
}

void ScanRun::stopClock() {
  if (clock_start_) elapsed_s_ += millisecondsSince(*clock_start_) / 1000.0;
  clock_start_.reset();
}

void ScanRun::refine(const Ending& ending) {
  const auto start = std::chrono::steady_clock::now();
  // What it would have found is no result that is lost.
  if (const Result<void> done = guarded("refining the objects", [&] { return runRefinement(ending); }); !done)
    spdlog::warn("The objects could not be refined. {}", done.error().message());
  if (refinement_.key_frames == 0) return;
  refinement_.seconds = millisecondsSince(start) / 1000.0;
  ending.enter(ScanState::finishing);
}

Result<void> ScanRun::runRefinement(const Ending& ending) {
  if (!recorder_ || !hasFrames()) return {};
  refinement_.skipped = true;  // until it is done
  SCANTROVE_TRY(save());
  Result<FinalPass::KeyFrames> key_frames = recorder_->storedFrames();
  if (!key_frames) return fail(key_frames.error());
  refinement_.skipped = !key_frames->empty();
  if (key_frames->empty()) return {};
  const auto tell = [this](int done, int steps) {
    listener_(RefinementStepped{done, steps, refinement_.key_frames});
  };
  FinalPass pass(*pipeline_, objects_->collector(), recorder_->folder(), std::move(*key_frames),
                 {ending.refines, tell, [this](const FrameObjects& objects) { announce(objects); }});
  refinement_.key_frames = pass.keyFrames();
  if (!ending.refines()) return {};
  ending.enter(ScanState::refining);
  const Result<void> done = pass.run(refinement_memory_.position);
  refinement_memory_.position = pass.position();
  refinement_.skipped = refinement_memory_.position.pass != RefinementPosition::Pass::done;
  return done;
}

void ScanRun::keepRefinement() {
  SessionMetadata metadata = refinementMetadata(true);
  if (refinement_.skipped) {
    refinement_memory_.collector = collectorMemory(objects_->collector().state());
    const RegionTable& table = pipeline_->regionTable();
    std::set<RegionId> known(table.regions().begin(), table.regions().end());
    std::erase_if(known, [&table](RegionId region) { return !table.isKnown(region); });
    refinement_memory_.known.assign(known.begin(), known.end());
    metadata = refinementMetadata(refinement_memory_, pipeline_->editor().log().entries());
  }
  for (const auto& [name, value] : metadata) recorder_->setMetadata(name, value);
}

Result<ScanReport> ScanRun::finish(const Ending& ending) {
  stopClock();
  FirstError outcome;
  // First what needs nothing but this process: a catalogue or a device may take its time to fail.
  if (output_ && !keeps_earlier_scan_) outcome.note(output_->writeTrajectory());
  refine(ending);
  outcome.note(guarded("storing what was found", [&] {
    return objects_->finish([this](const FrameObjects& objects) { announce(objects); });
  }));
  if (const auto advice = ScanAdvisor::adviceOn(frames_); advice && !request_.refine_session) advise(*advice);
  ScanReport report;
  outcome.note(guarded("making the report", [&]() -> Result<void> {
    fillReport(report);
    return {};
  }));
  if (recorder_) {
    outcome.note(guarded("keeping the scan", [&] {
      keepRefinement();
      if (output_) recorder_->setMetadata(kResultsKey, kResultsCurrent);
      return recorder_->finish(*pipeline_, objects_->collector());
    }));
  }
  if (output_ && !keeps_earlier_scan_) {
    const auto store = [this](const FinalLabelRecord& record) {
      return recorder_ ? recorder_->keepMetadata(kFinalLabelsKey, finalLabelsToText(record)) : Result<void>();
    };
    outcome.note(output_->finish(*pipeline_, objects_->labels(), report, store));
    for (const Error& remark : output_->remarks()) listener_(ScanAdvice{remark});
  }
  announceMapFailure();
  outcome.note(checkResult(report));
  SCANTROVE_TRY(outcome.result());
  return report;
}

void ScanRun::fillReport(ScanReport& report) {
  report.source = request_.source;
  report.device = compute_->deviceName();
  report.params = pipeline_->params();
  report.frames = frames_;
  report.lost_frames = lost_frames_;
  report.drift = drift_;
  report.advice = advice_;
  report.origin_m = origin_world_;
  report.fps = elapsed_s_ > 0 ? frames_.read / elapsed_s_ : 0;
  const DurationSummary frame_time = summarize(frame_ms_);
  report.frame_median_ms = frame_time.median_ms;
  report.frame_p95_ms = frame_time.p95_ms;
  for (const StageTimer::Stage& stage : pipeline_->timer().stages()) {
    const DurationSummary time = summarize(stage.all_ms);
    report.stages.push_back({stage.name, time.median_ms, time.p95_ms});
  }
  constexpr std::size_t kSlowest = 8;
  report.slowest_frames = slowestFrames(pipeline_->timer().stages(), kSlowest);
  for (const auto& [name, total_ms] : compute_->kernelTimes()) {
    report.kernels.push_back({name, total_ms / std::max(1, frames_.read)});
  }
  std::sort(report.kernels.begin(), report.kernels.end(),
            [](const auto& a, const auto& b) { return a.mean_ms > b.mean_ms; });
  report.peak_memory_mb = peakMemoryMegabytes();
  report.map_bricks = pipeline_->bricks().brickCount();
  report.map_megabytes = static_cast<double>(pipeline_->deviceBytes()) / (1 << 20);
  report.map_disk_megabytes = static_cast<double>(pipeline_->bricks().storedBytes()) / (1 << 20);
  const ScanPipeline::RegionCount regions = pipeline_->regionCount();
  report.regions = regions.regions;
  report.small_fragments = regions.small_fragments;
  report.refinement = refinement_;
  report.is_of_refinement = request_.refine_session;
  report.objects = objects_->collector().objects().list();
}

}  // namespace scantrove
