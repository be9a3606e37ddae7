// How ScanRun goes on in a session, takes a recording's poses, frame numbers and times, and what it keeps of
// its frames.
#include <algorithm>
#include <utility>

#include "core/catalogue/object_database.h"
#include "core/scan/catalogue_numbers.h"
#include "core/scan/scan_run.h"
#include "core/scan/session_restorer.h"
#include "core/scan/session_setup.h"

namespace scantrove {

Result<void> ScanRun::resumeSession(ObjectDatabase& database) {
  if (!earlier_) return {};
  const Result<CatalogueIdentity> identity = identityOf(database, earlier_->metadata);
  if (!identity) return fail(identity.error());
  const SavedScan on_disk = *earlier_;
  if (turnTo(*earlier_, *identity))
    listener_(CatalogueFailed{isAnotherCatalogue(*request_.output_folder, request_.database)});
  std::vector<std::string> damages;
  const bool for_camera = !request_.refine_session;
  SCANTROVE_TRY(restoreScan(*pipeline_, objects_.get(), *session_, *earlier_, for_camera, damages));
  for (const std::string& damage : damages) listener_(MapFailed{{damage, ""}});
  recorder_ = SessionRecorder::resume(std::move(session_), *pipeline_, *earlier_, request_.record_all);
  recorder_->rewriteFrom(on_disk, earlier_->metadata);
  if (request_.refine_session) {
    for (const RegionId region : refinement_memory_.known) pipeline_->kept().table.setKnown(region, true);
    snapshots_.addBricks(pipeline_->allBricks());
  } else {
    recorder_->setMetadata("ended", "");  // not this time, yet
    for (const auto& [name, value] : refinementMetadata(false)) recorder_->setMetadata(name, value);
    continueNumbers(earlier_->frames);
    if (output_) SCANTROVE_TRY(recorder_->keepMetadata(kResultsKey, kResultsBegun));
    if (output_ && request_.label_maps) SCANTROVE_TRY(recorder_->keepMetadata(kLabelImagesKey, "yes"));
  }
  recorder_->setMetadata("database", storedDatabaseName(request_.database, *request_.output_folder));
  if (output_) output_->begin(*earlier_);
  earlier_.reset();
  return {};
}

void ScanRun::takePoses() {
  std::optional<Eigen::Vector3d> origin;
  if (earlier_) origin = origin_world_;
  auto local = std::make_unique<LocalPoses>(std::move(source_), origin);
  local_poses_ = local.get();
  source_ = std::move(local);
}

void ScanRun::setOrigin(const Eigen::Vector3d& origin_world) {
  origin_world_ = origin_world;
  if (output_) output_->setOrigin(origin_world);
}

void ScanRun::continueNumbers(const std::vector<SavedFrame>& earlier) {
  if (earlier.empty()) return;
  const int last = std::ranges::max_element(earlier, {}, &SavedFrame::source_index)->source_index;
  const double last_s = std::ranges::max_element(earlier, {}, &SavedFrame::time_s)->time_s;
  auto continued = std::make_unique<ContinuedSource>(std::move(source_), last, last_s);
  continued_ = continued.get();
  source_ = std::move(continued);
}

void ScanRun::keepFrame(const RgbdFrame& frame, const FrameResult& result) {
  if (!std::exchange(is_recording_noted_, true)) {
    recorder_->beginRecording(request_.source,
                              continued_ != nullptr ? continued_->shift() : ContinuedSource::Shift{});
    recorder_->setMetadata(kOriginKey, originToText(origin_world_));
  }
  recorder_->addFrame(frame, result);
  recorder_->saveWhenDue(*pipeline_, objects_->collector());
}

}  // namespace scantrove
