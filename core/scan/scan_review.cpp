#include "core/scan/scan_review.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/overloaded.h"
#include "core/collection/objects_in_view.h"
#include "core/compute/guarded.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/project_export.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/rendered_view.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/project/project.h"
#include "core/project/project_scans.h"
#include "core/session/key_frame_files.h"
#include "core/session/painted_image.h"
#include "core/session/session_catalogue.h"

namespace scantrove {
namespace {

/// Above the versions of any scan, whose bricks the window may have.
constexpr std::uint64_t kVersionsOfScan = std::uint64_t{1} << 40U;

/// A smaller part of an image may be a remnant.
constexpr double kMinPart = 0.001;

/// The result that a frame with the current map would have had.
FrameResult resultOf(RenderedView view) {
  FrameResult result;
  result.pose.T_world_camera = view.T_world_camera;
  result.pose.state = TrackingState::tracking;
  result.view = std::move(view);
  return result;
}

}  // namespace

ScanReview::ScanReview(std::unique_ptr<OpenSession> session, ScanListener listener,
                       LatestValue<ScanSnapshot>& mailbox)
    : session_(std::move(session)), listener_(std::move(listener)), snapshots_(mailbox, kVersionsOfScan) {}

Result<std::unique_ptr<ScanReview>> ScanReview::open(const ScanRequest& request, const ScanParams& params,
                                                     ScanListener listener,
                                                     LatestValue<ScanSnapshot>& mailbox) {
  auto session = OpenSession::open(*request.output_folder, request.device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages()) listener(MapFailed{{damage, ""}});
  std::unique_ptr<ScanReview> review(new ScanReview(std::move(*session), std::move(listener), mailbox));
  review->device_ = request.device;
  OpenSession& opened = *review->session_;
  review->segmentation_ = params.segmentation;

  std::vector<int> in_source, numbers;
  std::vector<Eigen::Vector3f> trail;
  for (const SavedFrame& frame : opened.frames()) {
    if (frame.isUsable()) trail.push_back(frame.T_world_camera.translation().cast<float>());
  }
  for (const SavedKeyFrame& key : opened.keyFrames()) {
    const SavedFrame* frame = opened.frameOf(key);
    if (frame == nullptr || !frame->isUsable()) continue;
    review->key_frames_.push_back(&key);
    in_source.push_back(frame->source_index);
    numbers.push_back(key.frame);
  }
  review->snapshots_.setKeyFrames(std::move(in_source), std::move(numbers), std::move(trail));
  review->snapshots_.setLabels({[&opened] { return opened.labels(); }});
  // The newest, which was seen last when a scan has just ended.
  review->shown_ = static_cast<int>(review->key_frames_.size()) - 1;
  return review;
}

Result<void> ScanReview::showAll() {
  snapshots_.addBricks(session_->pipeline().readout().allBricks());
  return showCurrent();
}

Result<void> ScanReview::showKeyFrame(int place) {
  if (place < 0 || place >= static_cast<int>(key_frames_.size())) return {};
  shown_ = place;
  return showCurrent();
}

Result<void> ScanReview::showCurrent() {
  session_->readCatalogue();
  if (shown_ < 0) return post();
  MappingPipeline& pipeline = session_->pipeline();
  const SavedKeyFrame& key = *key_frames_[static_cast<std::size_t>(shown_)];
  const SavedFrame& saved = *session_->frameOf(key);
  Result<RenderedView> view =
      pipeline.readout().renderView(saved.T_world_camera, pipeline.workingIntrinsicsOf(saved.intrinsics));
  if (!view) return fail(view.error());
  const Result<std::optional<PaintedImage>> painted = PaintedImage::of(*session_, key);
  if (!painted) return fail(painted.error());
  if (*painted) (*painted)->applyTo(*view);
  Result<RgbdFrame> frame = readKeyFrame(session_->folder(), key, saved);
  // Its labels can be shown without its images.
  if (!frame) {
    listener_(MapFailed{frame.error()});
    frame = RgbdFrame{};
    frame->index = saved.source_index;
  }
  SCANTROVE_TRY(segment());
  snapshots_.setShownKeyFrame(shown_);
  FrameResult result = resultOf(std::move(*view));
  result.segments = segments_;
  std::vector<SeenObject> objects = objectsIn(result, *frame);
  snapshots_.showFrame(std::move(*frame), std::move(result), std::move(objects));
  return post();
}

std::vector<SeenObject> ScanReview::objectsIn(const FrameResult& result, const RgbdFrame& frame) const {
  const RenderedView& view = result.view;
  const SurfaceInColor in_color = locateInColor(frame.color_camera, view);
  std::vector<SeenObject> seen = objectsInView(
      view, in_color, [this](RegionId region) { return session_->labelOf(region).object; },
      static_cast<int>(kMinPart * static_cast<double>(view.K.pixels())));
  for (SeenObject& one : seen) {
    const RegionLabel label = session_->labelOf(*one.regions.begin());
    one.name = label.name;
    one.confirmed = label.confirmed;
  }
  return seen;
}

Result<void> ScanReview::segment() {
  if (segmented_ == shown_) return {};
  const SavedFrame& saved = *session_->frameOf(*key_frames_[static_cast<std::size_t>(shown_)]);
  MappingPipeline& pipeline = session_->pipeline();
  const Intrinsics K = pipeline.workingIntrinsicsOf(saved.intrinsics);
  SCANTROVE_TRY(moveInto(segments_, pipeline.segmentMapFrom(saved.T_world_camera, K, segmentation_)));
  segmented_ = shown_;
  return {};
}

Result<void> ScanReview::setParams(const ScanParams& params) {
  if (params.segmentation == segmentation_) return {};
  segmentation_ = params.segmentation;
  segmented_ = -1;
  if (shown_ < 0) return {};
  SCANTROVE_TRY(segment());
  snapshots_.showSegments(segments_);
  return post();
}

Result<void> ScanReview::post() {
  FrameCounts frames;
  for (const SavedFrame& frame : session_->frames()) {
    ++frames.read;
    ++(frame.isUsable() ? frames.tracked : frames.lost);
  }
  return snapshots_.flush(session_->pipeline(), {ScanState::finished, frames, frames.read});
}

Result<void> ScanReview::edit(const ScanEdit& edit) {
  snapshots_.beginEdit(session_->pipeline());
  const Result<RegionEditor::Outcome> outcome = std::visit(
      Overloaded{[&](const Operation& operation) { return session_->edit(operation); },
                 [&](UndoEdit) { return session_->undo(); }, [&](RedoEdit) { return session_->redo(); }},
      edit);
  snapshots_.endEdit(session_->pipeline());
  if (const std::optional<Error> failure = session_->takeFailure()) listener_(MapFailed{*failure});
  if (outcome) {
    const Result<void> applied = applyToCatalogue(*session_);
    if (!applied) listener_(CatalogueFailed{applied.error()});
    listener_(Edited{edit, outcome->regions});
  } else {
    listener_(EditFailed{edit, outcome.error()});
  }
  const bool is_review = outcome && outcome->operation.kind == OperationKind::review;
  return is_review ? post() : showCurrent();  // a review changes no picture
}

template <class Event, class Value>
void ScanReview::report(const Result<Value>& outcome) {
  if (outcome) {
    listener_(Event{*outcome});
  } else {
    listener_(ExportFailed{outcome.error(), !std::is_same_v<Event, ExportFinished>});
  }
}

void ScanReview::execute(LabelKeyFrame command) {
  if (command.index < 0 || command.index >= static_cast<int>(key_frames_.size())) return;
  const SavedKeyFrame& key = *key_frames_[static_cast<std::size_t>(command.index)];
  Result<KeyFrameLabels> labels =
      guarded("labelling a key frame", [&] { return labelKeyFrame(*session_, key); });
  if (!labels) return listener_(MapFailed{labels.error()});
  labels->index = command.index;
  listener_(KeyFrameLabeled{std::move(*labels)});
}

void ScanReview::execute(const PreviewExport& command) {
  SessionScan scan(*session_);
  report<ExportPreviewed>(
      guarded("previewing the data set", [&] { return previewExport(scan, command.options); }));
}

void ScanReview::execute(const SampleExport& command) {
  SessionScan scan(*session_);
  report<ExportSampled>(guarded("previewing an image of the data set",
                                [&] { return sampleExport(scan, command.options, command.index); }));
}

void ScanReview::execute(const ExportDataset& command, const std::stop_token& cancel) {
  SessionScan scan(*session_);
  session_->readCatalogue();
  if (session_->missingCatalogue()) listener_(CatalogueFailed{*session_->missingCatalogue()});
  const auto step = [&](const ExportProgress& progress) { listener_(ExportStepped{progress}); };
  report<ExportFinished>(
      guarded("writing the data set", [&] { return exportDataset(scan, command.options, step, cancel); }));
}

void ScanReview::execute(const ExportProject& command, const std::stop_token& cancel) {
  session_->readCatalogue();
  std::set<std::string> warned;
  const auto warn = [&](const std::string& sentence) {
    if (warned.insert(sentence).second) listener_(MapFailed{{sentence, ""}});
  };
  const auto step = [&](const ExportProgress& progress) { listener_(ExportStepped{progress}); };
  report<ExportFinished>(guarded("writing the data set", [&]() -> Result<ExportSummary> {
    const Result<Project> project = projectOfScan(session_->folder());
    if (!project) return fail(project.error());
    auto scans = scansToExport(*project, command.scans, device_, warn);
    if (!scans) return fail(scans.error());
    // A session cannot be opened twice.
    const auto own = std::make_shared<SessionScan>(*session_);
    for (ScanToExport& scan : *scans) {
      if (scan.name == own->name())
        scan.open = [own]() -> Result<std::shared_ptr<LabeledScan>> { return own; };
    }
    return exportProject({project->name, std::move(*scans), command.split}, command.options, step, cancel);
  }));
}

void ScanReview::execute(const RenderPicture& command, const std::stop_token& cancel) {
  SessionScan scan(*session_);
  session_->readCatalogue();
  const auto step = [&](int done, int total) { listener_(RenderStepped{done, total}); };
  const Result<void> drawn =
      guarded("drawing the scan", [&] { return renderScan(scan, command.options, step, cancel); });
  if (drawn) {
    listener_(RenderFinished{command.options.file});
  } else {
    listener_(RenderFailed{drawn.error()});
  }
}

}  // namespace scantrove
