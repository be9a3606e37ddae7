#include "core/scan/scan_opener.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "core/capture/depth_plausibility.h"
#include "core/capture/no_frames.h"
#include "core/capture/peeked_source.h"
#include "core/capture/rest_of_source.h"
#include "core/capture/usable_depth.h"
#include "core/catalogue/object_database.h"
#include "core/database/server_address.h"
#include "core/scan/open_source.h"
#include "core/session/catalogue_numbers.h"
#include "core/session/open_session.h"
#include "core/session/output_owner.h"
#include "core/session/recording_part.h"
#include "core/session/session_restorer.h"
#include "core/session/session_setup.h"

namespace scantrove {
namespace {

/// Tolerance of focal lengths and centres of one lens, and of one that focuses during recordings.
constexpr float kSameLens = 0.01F, kSameFocusingLens = 0.05F;

/// Voxels for a single object, which is near: as fine as the camera's pixels there allow.
float voxelOfObject(const Intrinsics& K) {
  constexpr float kFinest_m = 0.003F, kUsualDepth_m = 0.7F, kVoxelsPerFootprint = 1.5F;
  return std::max(kFinest_m, kVoxelsPerFootprint * kUsualDepth_m / K.fx);
}

/// The same resolution, and the same lens.
bool isSameCamera(const Intrinsics& a, const Intrinsics& b, float tolerance) {
  const auto isNear = [&](float x, float y, float scale) { return std::abs(x - y) <= tolerance * scale; };
  return a.width == b.width && a.height == b.height && isNear(a.fx, b.fx, a.fx) && isNear(a.fy, b.fy, a.fy) &&
         isNear(a.cx, b.cx, a.fx) && isNear(a.cy, b.cy, a.fy);
}

}  // namespace

Result<ScanParts> ScanOpener::open(const ScanRequest& request, const ScanListener& listener,
                                   std::function<void()> on_events) {
  ScanOpener opener(request, listener);
  opener.parts_.on_catalogue_events = std::move(on_events);
  SCANTROVE_TRY(opener.openAll());
  return std::move(opener.parts_);
}

Result<void> ScanOpener::openAll() {
  SCANTROVE_TRY(chooseObject());
  SCANTROVE_TRY(checkFolder());
  SCANTROVE_TRY(checkCatalogueName(parts_.request.database));  // before a session keeps the name
  SCANTROVE_TRY(openFrames());
  const SourceInfo& info = parts_.source->info();
  if (parts_.takesGivenPoses() && !info.has_poses) {
    return fail("The recording " + info.name + " (" + info.kind + ") has no poses.",
                "Leave out --poses given.");
  }
  const ScanRequest& request = parts_.request;
  if (!request.refine_session) fitMapToSensor();
  SCANTROVE_TRY(moveInto(parts_.compute, ComputeContext::create({.device = request.device,
                                                                 .profiling = request.profile_kernels,
                                                                 .on_compiling = [&listener = listener_] {
                                                                   listener(PreparingDevice{});
                                                                 }})));
  SCANTROVE_TRY(openOutput());
  SCANTROVE_TRY(openSession(info));
  if (parts_.poseUse() != PoseUse::none && !request.refine_session) takePoses();
  return openMap();
}

Result<void> ScanOpener::chooseObject() {
  ScanRequest& request = parts_.request;
  if (!request.object || request.refine_session) return {};
  if (request.resume) {
    return fail("A scan of one object cannot be continued: nothing tells where the object stands now.",
                "Scan it into a folder of its own.");
  }
  request.params.segmentation.rule = SegmentationParams::Rule::whole;
  return {};
}

Result<void> ScanOpener::checkFolder() const {
  const ScanRequest& request = parts_.request;
  if (!request.output_folder || request.refine_session || request.overwrite) return {};
  const ScanResults planned{request.results, request.results && request.label_maps};
  return request.resume ? checkResultsAreOurs(*request.output_folder, planned)
                        : checkHoldsOnlyOurs(*request.output_folder, planned);
}

Result<void> ScanOpener::openFrames() {
  if (parts_.request.refine_session) return openSessionToRefine();
  if (const auto& open = parts_.request.open_frames)
    return moveInto(parts_.source, open(parts_.request.source_options));
  return moveInto(parts_.source,
                  openSource(parts_.request.source, parts_.request.source_options, LostCamera::awaited));
}

void ScanOpener::fitMapToSensor() {
  auto source = std::make_unique<PeekedSource>(std::move(parts_.source));
  parts_.sensor.K = source->info().intrinsics;
  const FrameRead& first = source->peek();
  if (first.status == FrameRead::Status::frame) {
    parts_.sensor.median_depth_m =
        medianDepth(usableDepth(first.frame), static_cast<double>(first.frame.meters_per_unit));
  }
  parts_.source = std::move(source);
  FusionParams& fusion = parts_.request.params.fusion;
  if (parts_.request.object && fusion.voxel_size_m == kAutomatic)
    fusion.voxel_size_m = voxelOfObject(parts_.sensor.K);
  const FusionParams asked = std::exchange(fusion, fitToSensor(fusion, parts_.sensor));
  if (asked.voxel_size_m == fusion.voxel_size_m || fusion.voxel_size_m == FusionParams{}.voxel_size_m) return;
  spdlog::info("{}: a depth pixel covers {:.1f} mm at {:.1f} m, so the map has voxels of {:.1f} mm.",
               parts_.source->info().name, 1000 * parts_.sensor.footprint_m(), parts_.sensor.usualDepth_m(),
               1000 * fusion.voxel_size_m);
}

Result<void> ScanOpener::openSessionToRefine() {
  ScanRequest& request = parts_.request;
  const std::filesystem::path& folder = *request.output_folder;
  SCANTROVE_TRY(moveInto(session_, SessionWriter::start(folder, SessionWriter::Way::open)));
  SCANTROVE_TRY(loadEarlier());
  const Result<SessionSetup> setup = setupFrom(earlier_->metadata);
  if (!setup) return fail(setup.error());
  request.source = setup->source;
  request.params = setup->params;
  // A scan of the window has only a session.
  request.results = ownResults(folder).files;
  parts_.origin_world = setup->origin_m;
  request.database = databaseFileOf(*setup, folder).string();
  if (!mayCatalogueExist(request.database)) {
    return fail("The catalogue " + request.database + " of the scan " + folder.string() + " is not there.",
                "Put it back, then refine the scan.");
  }
  request.poses = ScanRequest::Poses::given;  // no more tracking
  FrameCounts& frames = parts_.earlier_frames;
  for (const SavedFrame& frame : earlier_->frames) {
    ++frames.read;
    ++(frame.isUsable() ? frames.tracked : frames.lost);
  }
  SourceInfo info;
  info.name = setup->source;
  info.kind = "session";
  info.intrinsics = setup->K;
  info.frame_count = frames.read;
  info.has_poses = true;
  parts_.source = std::make_unique<NoFrames>(std::move(info));
  if (auto memory = refinementMemoryFrom(earlier_->metadata, earlier_->operations))
    parts_.refinement = std::move(*memory);
  parts_.objectness = earlier_->objectness;
  dropMissingNetwork();
  return {};
}

void ScanOpener::dropMissingNetwork() {
  std::string& network = parts_.request.params.detection.model;
  std::error_code ignored;
  if (network.empty() || std::filesystem::exists(network, ignored)) return;
  listener_(MapFailed{{"The network " + network + " is not there. Objects are recognised without it.", ""}});
  network.clear();
}

Result<void> ScanOpener::openOutput() {
  const ScanRequest& request = parts_.request;
  if (!request.output_folder || !request.results) return {};
  SCANTROVE_TRY(moveInto(parts_.output, ScanOutput::create(*request.output_folder, request.label_maps)));
  parts_.output->setOrigin(parts_.origin_world);
  return {};
}

Result<void> ScanOpener::openSession(const SourceInfo& info) {
  const ScanRequest& request = parts_.request;
  if (!request.output_folder || request.refine_session) return {};
  const std::filesystem::path& folder = *request.output_folder;
  parts_.keeps_earlier_scan = !request.resume && holdsEarlierScan(folder);
  if (!request.session) return {};
  if (request.resume) {
    SCANTROVE_TRY(moveInto(session_, SessionWriter::start(folder, SessionWriter::Way::open)));
    return readSession(info);
  }
  SCANTROVE_TRY(beginSession(info));
  return checkFolder();  // checked again, because nobody else can start a scan there now
}

Result<void> ScanOpener::beginSession(const SourceInfo& info) {
  const ScanRequest& request = parts_.request;
  const ScanResults own = ownResults(*request.output_folder);
  SCANTROVE_TRY(moveInto(session_, SessionWriter::start(*request.output_folder, SessionWriter::Way::create)));
  SessionRecorder::Setup setup{.all_frames = request.record_all};
  setup.metadata = metadataOf({request.source, info.intrinsics, request.params,
                               storedDatabaseName(request.database, *request.output_folder),
                               Eigen::Vector3d::Zero(), std::string(toString(request.poses))});
  setup.metadata[kPartKey] = partInWords(request.source_options);
  setup.metadata.merge(refinementMetadata(false));
  // Files of an earlier scan that this one does not replace still belong to this program.
  const bool writes_labels = parts_.output && request.label_maps;
  if (parts_.output || own.files) setup.metadata[kResultsKey] = kResultsBegun;
  if (writes_labels || own.label_images) setup.metadata[kLabelImagesKey] = "yes";
  parts_.recorder = std::make_unique<SessionRecorder>(std::move(session_), std::move(setup));
  return {};
}

Result<void> ScanOpener::readSession(const SourceInfo& info) {
  ScanRequest& request = parts_.request;
  SCANTROVE_TRY(loadEarlier());
  const Result<SessionSetup> setup = setupFrom(earlier_->metadata);
  if (!setup) return fail(setup.error());
  const bool focuses = std::ranges::any_of(
      earlier_->frames, [](const SavedFrame& frame) { return frame.intrinsics.has_value(); });
  if (!isSameCamera(setup->K, info.intrinsics, focuses ? kSameFocusingLens : kSameLens)) {
    return fail("The session " + request.output_folder->string() +
                    " was scanned with another camera than that of " + info.name + ".",
                "Scan into a folder of its own.");
  }
  if (setup->K != info.intrinsics) own_intrinsics_ = info.intrinsics;
  request.params.fusion = setup->params.fusion;
  parts_.setOrigin(setup->origin_m);
  continuePoseUse(setup->poses, info);
  if (!request.database.empty()) return {};
  std::filesystem::path file = databaseFileOf(*setup, *request.output_folder);
  // The session may have been copied without its catalogue.
  if (!mayCatalogueExist(file)) file = *request.output_folder / "catalogue.sqlite";
  request.database = file.string();
  return {};
}

void ScanOpener::continuePoseUse(const std::string& earlier, const SourceInfo& info) {
  ScanRequest& request = parts_.request;
  if (request.poses != ScanRequest::Poses::automatic) return;
  const ScanRequest::Poses poses = posesFrom(earlier).value_or(request.poses);
  if (poses != ScanRequest::Poses::given || info.has_poses) request.poses = poses;
}

Result<void> ScanOpener::loadEarlier() {
  std::vector<std::string> damages;
  SCANTROVE_TRY(moveInto(earlier_, loadScan(*session_, damages)));
  const auto pending = earlier_->metadata.find(kPendingEditsKey);
  if (pending != earlier_->metadata.end() && !pending->second.empty()) {
    const std::filesystem::path folder = session_->folder();
    session_.reset();  // only one at a time
    // Opening completes the edits that are possible now; others wait.
    if (const auto opened = OpenSession::open(folder, parts_.request.device); !opened)
      return fail(opened.error());
    SCANTROVE_TRY(moveInto(session_, SessionWriter::start(folder, SessionWriter::Way::open)));
    SCANTROVE_TRY(moveInto(earlier_, loadScan(*session_, damages)));
  }
  reportDamages(damages);
  return {};
}

void ScanOpener::reportDamages(const std::vector<std::string>& damages) const {
  for (const std::string& damage : damages) listener_(MapFailed{{damage, ""}});
}

void ScanOpener::takePoses() {
  std::optional<Eigen::Vector3d> origin;
  if (earlier_) origin = parts_.origin_world;
  using enum LocalPoses::Implausible;
  auto local = std::make_unique<LocalPoses>(std::move(parts_.source), origin,
                                            parts_.takesGivenPoses() ? skipped : without_pose);
  parts_.local_poses = local.get();
  parts_.source = std::move(local);
}

Result<void> ScanOpener::openMap() {
  const std::string& file = parts_.request.database;
  const Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(file);
  if (!database) return fail(database.error());
  std::string catalogue;
  SCANTROVE_TRY(moveInto(catalogue, (*database)->identity()));
  if (parts_.recorder) parts_.recorder->setCatalogue(catalogue);
  if (parts_.request.refine_session && isOfAnotherCatalogue(catalogue))
    return fail(isAnotherCatalogue(*parts_.request.output_folder, file));
  SCANTROVE_TRY(parts_.makeMap(**database));
  return earlier_ ? restoreSession(**database) : Result<void>();
}

bool ScanOpener::isSameRecording() const {
  if (earlier_->recordings.empty()) return false;
  const std::filesystem::path last = earlier_->recordings.back().source, now = parts_.request.source;
  std::error_code ignored;
  return last == now || std::filesystem::equivalent(last, now, ignored);
}

bool ScanOpener::isOfAnotherCatalogue(const std::string& catalogue) const {
  const auto own = earlier_->metadata.find(kCatalogueKey);
  return own != earlier_->metadata.end() && !own->second.empty() && own->second != catalogue;
}

Result<void> ScanOpener::restoreSession(ObjectDatabase& database) {
  const ScanRequest& request = parts_.request;
  const Result<CatalogueIdentity> identity = identityOf(database, earlier_->metadata);
  if (!identity) return fail(identity.error());
  const SavedScan on_disk = *earlier_;
  if (turnTo(*earlier_, *identity))
    listener_(CatalogueFailed{isAnotherCatalogue(*request.output_folder, request.database)});
  std::vector<std::string> damages;
  const bool for_camera = !request.refine_session;
  if (for_camera) beginAnewWithoutMap();
  SCANTROVE_TRY(restoreScan(*parts_.pipeline, *session_, *earlier_, for_camera, damages));
  if (!isSameRecording()) parts_.pipeline->camera().forgetDevice();
  parts_.objects->restore(*earlier_);
  reportDamages(damages);
  parts_.recorder =
      SessionRecorder::resume(std::move(session_), *parts_.pipeline, *earlier_, request.record_all);
  SessionRecorder& recorder = *parts_.recorder;
  recorder.rewriteFrom(on_disk, *earlier_);
  if (request.refine_session) {
    RegionTable& table = parts_.pipeline->labels().table();
    for (const RegionId region : parts_.refinement.known) table.setKnown(region, true);
  } else {
    recorder.setMetadata("ended", "");  // not ended this time
    recorder.setMetadata(kReadToEndKey, "");
    recorder.setMetadata(kPosesKey, std::string(toString(request.poses)));
    const auto part = earlier_->metadata.find(kPartKey);
    const bool is_same_part = isSameRecording() && part != earlier_->metadata.end() &&
                              part->second == partInWords(request.source_options);
    if (!is_same_part) recorder.setMetadata(kPartKey, "");
    for (const auto& [name, value] : refinementMetadata(false)) recorder.setMetadata(name, value);
    leaveOutReadFrames();
    continueNumbers(earlier_->frames);
    if (parts_.output) SCANTROVE_TRY(recorder.keepMetadata(kResultsKey, kResultsBegun));
    if (parts_.output && request.label_maps) SCANTROVE_TRY(recorder.keepMetadata(kLabelImagesKey, "yes"));
  }
  recorder.setMetadata("database", storedDatabaseName(request.database, *request.output_folder));
  if (parts_.output) parts_.output->begin(*earlier_);
  return {};
}

void ScanOpener::beginAnewWithoutMap() {
  const int lost = loseFramesWithoutMap(*earlier_);
  if (lost == 0) return;
  listener_(MapFailed{{"The scan in " + parts_.request.output_folder->string() +
                           " was interrupted before its map was stored. It begins anew.",
                       ""}});
}

void ScanOpener::leaveOutReadFrames() {
  if (!parts_.request.rest_only || parts_.source->info().is_live || !isSameRecording()) return;
  const SavedRecording& recording = earlier_->recordings.back();
  int last = std::numeric_limits<int>::min(), read = 0;
  for (const SavedFrame& frame : earlier_->frames) {
    if (frame.number < recording.first_frame) continue;
    last = std::max(last, frame.source_index - recording.index_shift);
    ++read;
  }
  if (read > 0) parts_.source = std::make_unique<RestOfSource>(std::move(parts_.source), last, read);
}

void ScanOpener::continueNumbers(const std::vector<SavedFrame>& earlier) {
  if (earlier.empty()) return;
  const int last = std::ranges::max_element(earlier, {}, &SavedFrame::source_index)->source_index;
  const double last_s = std::ranges::max_element(earlier, {}, &SavedFrame::time_s)->time_s;
  auto continued = std::make_unique<ContinuedSource>(std::move(parts_.source), last, last_s, own_intrinsics_);
  parts_.continued = continued.get();
  parts_.source = std::move(continued);
}

}  // namespace scantrove
