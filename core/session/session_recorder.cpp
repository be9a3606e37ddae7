#include "core/session/session_recorder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/labeling/evidence_graph.h"
#include "core/session/catalogue_numbers.h"
#include "core/session/key_frame_files.h"
#include "core/session/session_restorer.h"

namespace scantrove {
namespace {

/// Frames that may still be integrated late.
constexpr std::size_t kRememberedFrames = 200;

/// Bricks of pages handed over per second of scanning, split over the frames: about the new bricks of one
/// view in a second. And the maximum at once (6 MB).
constexpr double kBricksPerSecond = 10'000;
constexpr std::size_t kBricksAtOnce = 1024;
/// Maximum number of batches of pages that wait for the disk.
constexpr std::size_t kMaxWaitingPages = 2;

}  // namespace

SessionRecorder::SessionRecorder(std::unique_ptr<SessionWriter> writer, Setup setup)
    : writer_(std::move(writer)), setup_(std::move(setup)), last_save_(std::chrono::steady_clock::now()) {
  // Before the first frame, so that the folder is a session even after a crash.
  if (setup_.metadata.empty()) return;
  SavedDelta beginning;
  beginning.metadata = std::exchange(setup_.metadata, {});
  hand(std::move(beginning));
}

std::unique_ptr<SessionRecorder> SessionRecorder::resume(std::unique_ptr<SessionWriter> writer,
                                                         MappingPipeline& pipeline, const SavedScan& scan,
                                                         bool all_frames) {
  Setup setup{.all_frames = all_frames};
  if (!scan.frames.empty()) setup.frames = scan.frames.back().number + 1;
  for (const SavedKeyFrame& key : scan.key_frames) {
    const auto of = std::ranges::find(scan.frames, key.frame, &SavedFrame::number);
    if (of == scan.frames.end() || !of->isUsable()) continue;
    (key.color_file.empty() ? setup.without_color : setup.key_frames).takes(of->T_world_camera);
  }
  auto recorder = std::make_unique<SessionRecorder>(std::move(writer), std::move(setup));
  // The restored state is on disk.
  static_cast<void>(pipeline.labels().table().takeChanged(RegionTable::Reader::session));
  recorder->voxels_.resize(pipeline.labels().table().regions().size(), 0);
  for (const SavedFragment& one : scan.fragments) recorder->voxels_[one.fragment.value] = one.voxels;
  for (std::uint32_t fragment = 0; fragment < pipeline.labels().table().regions().size(); ++fragment) {
    recorder->seen_from_.push_back(pipeline.labels().table().seenFrom(FragmentId{fragment}));
    recorder->support_pixels_.push_back(pipeline.labels().table().supportPixels(FragmentId{fragment}));
  }
  for (const SavedRegion& region : scan.regions) {
    recorder->regions_[region.region] = region;
    recorder->objects_[region.region] = region.object;
    const auto namings = scan.metadata.find(namingsKeyOf(region.region));
    if (namings == scan.metadata.end()) continue;
    recorder->namings_[region.region] = namings->second;
  }
  if (const auto objects = scan.metadata.find(kObjectsKey); objects != scan.metadata.end())
    recorder->remembered_ = rememberedFrom(objects->second);
  if (const auto catalogue = scan.metadata.find(kCatalogueKey); catalogue != scan.metadata.end())
    recorder->catalogue_ = catalogue->second;
  recorder->view_ = pipeline.bricks().view();
  return recorder;
}

void SessionRecorder::setCatalogue(const std::string& identity) {
  catalogue_ = identity;
  setMetadata(kCatalogueKey, identity);
}

Result<void> SessionRecorder::keepMetadata(const std::string& name, const std::string& value) {
  SavedDelta delta;
  delta.metadata[name] = value;
  hand(std::move(delta));
  return writer_->flush();
}

void SessionRecorder::rewriteFrom(const SavedScan& on_disk, const SavedScan& now) {
  regions_.clear();
  for (const SavedRegion& region : on_disk.regions) regions_[region.region] = region;
  for (std::size_t i = 0; i < now.frames.size(); ++i) {
    if (now.frames[i].state != on_disk.frames[i].state) frames_.push_back(now.frames[i]);
  }
  for (const auto& [name, value] : now.metadata) {
    const auto before = on_disk.metadata.find(name);
    if (before == on_disk.metadata.end() || before->second != value) setMetadata(name, value);
  }
}

void SessionRecorder::beginRecording(const std::string& source, const ContinuedSource::Shift& shift) {
  recordings_.push_back({setup_.frames, source, shift.index, shift.time_s});
}

void SessionRecorder::restart() {
  for (SavedFrame frame : std::exchange(first_usable_, {})) {
    frame.state = TrackingState::lost;
    frame.T_world_camera.setIdentity();
    frames_.push_back(std::move(frame));
  }
  setup_.key_frames = setup_.without_color = {};
  color_ = {};
  voxels_.clear();
  seen_from_.clear();
  support_pixels_.clear();
  regions_.clear();
  objects_.clear();
  pages_.clear();
  saves_pages_ = false;
  view_ = next_view_ = 0;
  writer_->post([](SessionStore& store) { return store.forgetMap(); });
}

void SessionRecorder::addFrame(const RgbdFrame& frame, const FrameResult& result) {
  const int number = setup_.frames++;
  const SavedFrame saved{
      number,          frame.index, frame.timestamp_s, result.pose.state, result.pose.T_world_camera,
      frame.intrinsics};
  frames_.push_back(saved);
  keepFirst(frames_.back());
  known_frames_[frame.index] = {number, frame.intrinsics};
  if (known_frames_.size() > kRememberedFrames) known_frames_.erase(known_frames_.begin());
  for (const LateFrame& late : result.late) {
    const auto known = known_frames_.find(late.index);
    if (known == known_frames_.end()) continue;
    frames_.push_back({known->second.number, late.index, late.timestamp_s, late.pose.state,
                       late.pose.T_world_camera, known->second.intrinsics});
    keepFirst(frames_.back());
  }
  if (writer_->isFailing() || !isKeyFrame(frame, result)) return;
  writer_->post([frame, number, saved](SessionStore& store) -> Result<void> {
    const Result<SavedKeyFrame> key = writeKeyFrame(store, number, frame);
    if (!key) return fail(key.error());
    return store.saveKeyFrame(saved, *key);
  });
}

bool SessionRecorder::isKeyFrame(const RgbdFrame& frame, const FrameResult& result) {
  const Eigen::Isometry3d& T_world_camera = result.pose.T_world_camera;
  bool is_new = false;
  if (result.pose.usable()) {
    const bool has_color = !frame.color.empty();
    color_.add(has_color);
    is_new = has_color ? setup_.key_frames.takes(T_world_camera)
                       : !color_.isExpected() && setup_.key_frames.isNew(T_world_camera) &&
                             setup_.without_color.takes(T_world_camera);
  }
  // A continued camera relocalises with the same frames as an uninterrupted one.
  return is_new || result.is_tracking_key_frame || setup_.all_frames;
}

void SessionRecorder::keepFirst(const SavedFrame& frame) {
  if (frame.isUsable() && first_usable_.size() < kFirstFrames) first_usable_.push_back(frame);
}

Result<std::vector<SessionRecorder::StoredFrame>> SessionRecorder::storedFrames() {
  std::vector<std::string> damages;
  const Result<SavedScan> scan = loadScan(*writer_, damages);
  if (!scan) return fail(scan.error());
  std::vector<StoredFrame> kept;
  for (const SavedKeyFrame& images : scan->key_frames) {
    const auto frame = std::ranges::find(scan->frames, images.frame, &SavedFrame::number);
    if (frame != scan->frames.end() && frame->isUsable()) kept.push_back({images, *frame});
  }
  return kept;
}

ObjectId SessionRecorder::objectOf(RegionId region) const {
  const auto found = objects_.find(region);
  return found == objects_.end() ? ObjectId{} : found->second;
}

void SessionRecorder::collectRegions(MappingPipeline& pipeline, const ObjectCollector* collector,
                                     SavedDelta& delta) {
  RegionTable& table = pipeline.labels().table();
  const std::vector<cl_int>& voxels = pipeline.labels().voxelsOfFragments();
  std::vector<bool> is_changed(table.regions().size(), false);
  for (const FragmentId fragment : table.takeChanged(RegionTable::Reader::session))
    is_changed[fragment.value] = true;
  voxels_.resize(table.regions().size(), 0);
  seen_from_.resize(table.regions().size());
  support_pixels_.resize(table.regions().size());
  for (std::uint32_t fragment = 1; fragment < table.regions().size(); ++fragment) {
    const int now = fragment < voxels.size() ? voxels[fragment] : 0;
    const ViewCoverage seen_from = table.seenFrom(FragmentId{fragment});
    const SupportPixels support_pixels = table.supportPixels(FragmentId{fragment});
    if (!is_changed[fragment] && now == voxels_[fragment] && seen_from == seen_from_[fragment] &&
        support_pixels == support_pixels_[fragment])
      continue;
    voxels_[fragment] = now;
    seen_from_[fragment] = seen_from;
    support_pixels_[fragment] = support_pixels;
    delta.fragments.push_back(
        {FragmentId{fragment}, table.regions()[fragment], now, seen_from, support_pixels});
  }
  std::map<RegionId, SavedRegion> regions;
  for (const auto& [region, note] : pipeline.labels().editor().notes().all())
    regions[region] = {region, {}, note};
  if (collector == nullptr) {
    // Without a catalogue regions keep their objects.
    for (const auto& [region, object] : objects_) {
      if (!object || table.fragmentsOf(region).empty()) continue;
      regions[region].region = region;
      regions[region].object = object;
    }
  } else {
    for (const RegionId region : table.regions()) {
      if (!region) continue;
      const ObjectId object = collector->objects().idOf(region);
      if (!object) continue;
      SavedRegion& saved = regions[region];
      saved.region = region;
      saved.object = object;
    }
  }
  for (const auto& [region, saved] : regions) {
    const auto before = regions_.find(region);
    if (before == regions_.end() || before->second != saved) delta.regions.push_back(saved);
  }
  for (const auto& [region, saved] : regions_) {
    if (!regions.contains(region)) delta.regions.push_back({region, {}, {}});
  }
  regions_ = std::move(regions);
}

void SessionRecorder::collectNamings(const ObjectCollector& collector, SavedDelta& delta) {
  auto namings = collector.requests().storedNamings();
  for (const auto& [region, text] : namings_) namings.try_emplace(region);
  for (const auto& [region, kept] : namings) {
    std::string text = namingsToJson(kept);
    std::string& before = namings_[region];
    if (text == before) continue;
    before = std::move(text);
    delta.metadata[namingsKeyOf(region)] = before;
  }
}

void SessionRecorder::collectObjects(const MappingPipeline& pipeline, const ObjectCollector& collector,
                                     SavedDelta& delta) {
  std::map<RegionId, RegionObject> now;
  for (const RegionId region : pipeline.labels().table().regions()) {
    if (region && !now.contains(region)) now[region] = collector.objects().describe(region);
  }
  // Regions that are no objects here keep data from another catalogue.
  std::erase_if(now, [](const auto& entry) { return entry.second.state == RegionObject::State::none; });
  RememberedObjects all = remember(remembered_, now, catalogue_);
  if (all == remembered_) return;
  remembered_ = std::move(all);
  delta.metadata[kObjectsKey] = rememberedToText(remembered_);
}

void SessionRecorder::beginPages(const BrickMap& bricks) {
  pages_ = bricks.pagesByPosition();
  std::erase_if(pages_, [&](int page) { return bricks.pages().page(page).last_view <= view_; });
  std::ranges::reverse(pages_);
  next_view_ = bricks.view();
  saves_pages_ = true;
  last_save_ = std::chrono::steady_clock::now();
}

bool SessionRecorder::handSomePages(BrickMap& bricks, std::size_t enough) {
  HandedPages pages;
  for (std::size_t count = 0; count < enough && !pages_.empty(); pages_.pop_back()) {
    std::optional<StoredPage> copy = bricks.copyOfPage(pages_.back());
    if (!copy || copy->bricks.none()) continue;
    count += copy->bricks.count();
    pages.emplace_back(bricks.pages().page(pages_.back()).position, std::move(*copy));
  }
  const auto some = std::make_shared<const HandedPages>(std::move(pages));
  handed_pages_.push_back(some);
  writer_->post([some](SessionStore& store) -> Result<void> {
    for (const auto& [position, page] : *some)
      SCANTROVE_TRY(store.writePages(std::array{SavedPage{position, page.toWords()}}));
    return {};
  });
  return pages_.empty();
}

void SessionRecorder::endPages(MappingPipeline& pipeline, const ObjectCollector* collector) {
  hand(collect(pipeline, collector));
  view_ = next_view_;
  saves_pages_ = false;
}

bool SessionRecorder::arePagesWaiting() {
  std::erase_if(handed_pages_, [](const auto& pages) { return pages.expired(); });
  return handed_pages_.size() >= kMaxWaitingPages;
}

SavedDelta SessionRecorder::collect(MappingPipeline& pipeline, const ObjectCollector* collector) {
  SavedDelta delta;
  delta.metadata = std::exchange(setup_.metadata, {});  // as at the scan's end
  delta.metadata["last_region"] = std::to_string(pipeline.labels().table().lastRegion().value);
  delta.frames = std::exchange(frames_, {});
  delta.recordings = std::exchange(recordings_, {});
  collectRegions(pipeline, collector, delta);
  if (collector != nullptr) {
    collectNamings(*collector, delta);
    collectObjects(pipeline, *collector, delta);
  }
  if (EvidenceGraph* graph = pipeline.labels().merger().evidence()) {
    for (const auto& [a, b] : graph->takeChanged()) {
      const BorderEvidence* border = graph->find(a, b);
      delta.borders.push_back({a, b, border != nullptr ? std::optional(*border) : std::nullopt});
    }
  }
  delta.objectness = std::exchange(setup_.objectness, std::nullopt);
  delta.estimates = pipeline.labels().estimated().takeChanged();
  OperationLog& log = pipeline.labels().editor().log();
  for (const std::size_t place : log.takeChanged()) delta.operations.push_back(log.entries()[place]);
  return delta;
}

void SessionRecorder::hand(SavedDelta delta) {
  writer_->post([delta = std::make_shared<const SavedDelta>(std::move(delta))](SessionStore& store) {
    return store.save(*delta);
  });
}

void SessionRecorder::saveWhenDue(MappingPipeline& pipeline, const ObjectCollector& collector) {
  const auto now = std::chrono::steady_clock::now();
  const bool is_due = now - last_save_ >= kBetweenSaves;
  // While the disk accepts nothing, changes stay where they are.
  if (writer_->isFailing()) {
    if (!is_due) return;
    last_save_ = now;
    return writer_->post([](SessionStore& /*store*/) -> Result<void> { return {}; });  // to try again
  }
  BrickMap& bricks = pipeline.bricks();
  if (!saves_pages_) {
    if (!is_due) return;
    beginPages(bricks);
    last_handed_ = now;
  }
  if (arePagesWaiting()) return;
  const std::chrono::duration<double> since = now - std::exchange(last_handed_, now);
  const auto enough = 1 + static_cast<std::size_t>(kBricksPerSecond * since.count());
  if (!handSomePages(bricks, std::min(enough, kBricksAtOnce))) return;
  endPages(pipeline, &collector);
}

Result<void> SessionRecorder::save(MappingPipeline& pipeline, const ObjectCollector* collector) {
  BrickMap& bricks = pipeline.bricks();
  beginPages(bricks);
  while (!handSomePages(bricks, kBricksAtOnce)) SCANTROVE_TRY(writer_->flush());
  endPages(pipeline, collector);
  return writer_->flush();
}

Result<void> SessionRecorder::finish(MappingPipeline& pipeline, const ObjectCollector& collector,
                                     SavedObjectness objectness) {
  setMetadata("ended", "yes");
  setup_.objectness = std::move(objectness);
  const std::optional<CameraMemory> memory = pipeline.camera().memory();
  SCANTROVE_TRY(save(pipeline, &collector));
  // By itself: the rest is stored even if the disk has no room for it.
  SavedDelta camera;
  if (memory) camera.camera = {setup_.frames - 1, toWords(*memory)};
  hand(std::move(camera));
  SCANTROVE_TRY(writer_->flush());
  return findDisturbance();
}

Result<void> SessionRecorder::findDisturbance() {
  std::optional<Error> lost;
  writer_->post([&](SessionStore& store) { return moveInto(lost, store.findLostImages()); });
  SCANTROVE_TRY(writer_->flush());
  if (const std::optional<Error> disturbance = writer_->disturbance()) return fail(*disturbance);
  return lost ? Result<void>(fail(*lost)) : Result<void>();
}

}  // namespace scantrove
