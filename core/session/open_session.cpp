#include "core/session/open_session.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/catalogue/object_database.h"
#include "core/compute/compute_context.h"
#include "core/compute/guarded.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/catalogue_numbers.h"
#include "core/session/mask_corrections.h"
#include "core/session/painted_image.h"
#include "core/session/painted_view.h"
#include "core/session/refinement_state.h"
#include "core/session/session_catalogue.h"
#include "core/session/session_joining.h"
#include "core/session/session_recorder.h"
#include "core/session/session_restorer.h"

namespace scantrove {
namespace {

/// A session's copy of objects, without regions that were edited again.
std::string withoutRegions(const std::string& remembered, const std::vector<RegionId>& regions) {
  RememberedObjects objects = rememberedFrom(remembered);
  for (const RegionId region : regions) objects.erase(region);
  return rememberedToText(objects);
}

}  // namespace

OpenSession::OpenSession(std::filesystem::path folder) : folder_(std::move(folder)) {}

OpenSession::~OpenSession() = default;

const OperationLog& OpenSession::history() const { return pipeline_->labels().editor().log(); }

const RegionNote& OpenSession::noteOf(RegionId region) const {
  return pipeline_->labels().editor().notes().of(region);
}

ObjectId OpenSession::objectOf(RegionId region) const { return recorder_->objectOf(region); }

Result<void> OpenSession::saveMetadata() {
  rememberObjects();
  return recorder_->save(*pipeline_);
}

std::string OpenSession::metadata(const std::string& name) const {
  const auto found = scan_.metadata.find(name);
  return found == scan_.metadata.end() ? std::string() : found->second;
}

Result<bool> OpenSession::useCatalogue(ObjectDatabase& database) {
  const Result<CatalogueIdentity> identity = identityOf(database, scan_.metadata);
  if (!identity) return fail(identity.error());
  CatalogueNumbers numbers{scan_.metadata, recorder_->objects()};
  const bool is_other = turnTo(numbers, *identity);
  for (const auto& [name, value] : numbers.metadata) {
    if (metadata(name) != value) setMetadata(name, value);
  }
  recorder_->setObjects(std::move(numbers.objects));
  return is_other;
}

void OpenSession::readCatalogue() {
  catalogue_.reset();
  missing_catalogue_.reset();
  const std::filesystem::path file = databaseFileOf(setup_, folder_);
  const auto read = [&]() -> Result<void> {
    const auto database = ObjectDatabase::openToRead(file.string());
    if (!database) return fail(database.error());
    const Result<bool> is_other = useCatalogue(**database);
    if (!is_other) return fail(is_other.error());
    if (*is_other) damages_.push_back(isAnotherCatalogue(folder_, file.string()).message());
    return moveInto(catalogue_, (*database)->model());
  };
  const bool is_read = mayCatalogueExist(file) && guarded("reading the catalogue", read);
  region_objects_.clear();
  labels_.clear();
  std::set<RegionId> regions;
  for (const auto& [region, note] : pipeline_->labels().editor().notes().all()) regions.insert(region);
  for (const auto& [region, object] : recorder_->objects()) regions.insert(region);
  const RememberedObjects remembered = rememberedFrom(metadata(kObjectsKey));
  for (const auto& [region, object] : remembered) regions.insert(region);
  for (const RegionId region : regions) {
    if (pipeline_->labels().table().fragmentsOf(region).empty()) continue;
    region_objects_[region] = regionObjectOf(region, remembered);
    labels_[region] = scantrove::labelOf(noteOf(region), region_objects_[region],
                                         metadata(sessionOnlyKeyOf(region)) == noteOf(region).name);
  }
  shareClasses(labels_, region_objects_);
  const bool is_any = std::ranges::any_of(labels_, [](const auto& one) { return bool(one.second.object); });
  if (!is_read && is_any && !file.empty()) {
    missing_catalogue_ = Error{"The catalogue " + file.string() + " of " + folder_.string() +
                                   " cannot be read: objects are called what the session kept.",
                               "Put it back for the names that they have now."};
  }
}

RegionObject OpenSession::regionObjectOf(RegionId region, const RememberedObjects& remembered) const {
  const ObjectId object = objectOf(region);
  if (catalogue_ && object) return scantrove::regionObjectOf(*catalogue_, object);
  const auto kept = remembered.find(region);
  if (!object) {
    // From another catalogue: the name is known, but no id.
    if (kept == remembered.end() || kept->second.catalogue == metadata(kCatalogueKey)) return {};
    RegionObject known = kept->second.object;
    known.object = {};
    known.class_id = {};
    return known;
  }
  if (kept != remembered.end()) return kept->second.object;
  return {.state = RegionObject::State::known, .object = object};
}

RegionLabel OpenSession::labelOf(RegionId region) const {
  const auto found = labels_.find(region);
  return found == labels_.end() ? RegionLabel{} : found->second;
}

void OpenSession::rememberObjects() {
  readCatalogue();
  if (!catalogue_) return;
  std::map<RegionId, RegionObject> now;
  for (const auto& [region, object] : recorder_->objects()) {
    const auto found = region_objects_.find(region);
    if (object && found != region_objects_.end()) now[region] = found->second;
  }
  const std::string text =
      rememberedToText(remember(rememberedFrom(metadata(kObjectsKey)), now, metadata(kCatalogueKey)));
  if (text != metadata(kObjectsKey)) setMetadata(kObjectsKey, text);
}

std::optional<bool> OpenSession::areResultsCurrent() const {
  const std::string results = metadata(kResultsKey);
  if (results.empty() || results == kResultsBegun) return std::nullopt;
  return results == kResultsCurrent;
}

void OpenSession::setMetadata(const std::string& name, const std::string& value) {
  scan_.metadata[name] = value;
  recorder_->setMetadata(name, value);
}

bool OpenSession::canBeRefined() const { return scantrove::canBeRefined(scan_.metadata); }

std::vector<PendingEdit> OpenSession::pendingEdits() const {
  return pendingEditsFromJson(metadata(kPendingEditsKey));
}

Result<void> OpenSession::completeEdit(const SessionMetadata& metadata,
                                       const std::map<RegionId, ObjectId>& objects) {
  std::vector<PendingEdit> pending = pendingEdits();
  if (!pending.empty()) pending.erase(pending.begin());
  setMetadata(kPendingEditsKey, pendingEditsToJson(pending));
  for (const auto& [name, value] : metadata) setMetadata(name, value);
  for (const auto& [region, object] : objects) recorder_->setObject(region, object);
  return saveMetadata();
}

int OpenSession::brickCount() const { return pipeline_->bricks().brickCount(); }

Result<std::unique_ptr<OpenSession>> OpenSession::open(const std::filesystem::path& folder,
                                                       const std::string& device) {
  std::unique_ptr<OpenSession> session(new OpenSession(folder));
  std::unique_ptr<SessionWriter> writer;
  SCANTROVE_TRY(moveInto(writer, SessionWriter::start(folder, SessionWriter::Way::open)));
  SCANTROVE_TRY(moveInto(session->scan_, loadScan(*writer, session->damages_)));
  SCANTROVE_TRY(moveInto(session->setup_, setupFrom(session->scan_.metadata)));
  SCANTROVE_TRY(moveInto(session->compute_, ComputeContext::create({.device = device})));
  SCANTROVE_TRY(moveInto(session->pipeline_,
                         MappingPipeline::create(*session->compute_, {.K = session->setup_.K,
                                                                      .params = session->setup_.params})));
  SCANTROVE_TRY(restoreScan(*session->pipeline_, *writer, session->scan_, false, session->damages_));
  session->recorder_ = SessionRecorder::resume(std::move(writer), *session->pipeline_, session->scan_, false);
  session->readCatalogue();
  session->completePendingEdits();
  return session;
}

void OpenSession::completePendingEdits() {
  // A missing catalogue is reported when it is needed.
  if (!isCataloguePending(*this) || !mayCatalogueExist(catalogueFileOf(*this))) return;
  if (const Result<void> applied = applyToCatalogue(*this); !applied)
    damages_.push_back("The last edits are not in the catalogue: " + applied.error().message());
}

Result<std::vector<RegionSummary>> OpenSession::regions() {
  readCatalogue();
  std::map<RegionId, RegionSummary> regions;
  std::map<RegionId, Eigen::Vector3d> sums;
  const RegionTable& table = pipeline_->labels().table();
  SCANTROVE_TRY(pipeline_->readout().forEachCloudPoint([&](const LabelPoint& point) {
    if (point.fragment >= table.regions().size()) return;
    const RegionId region = table.regions()[point.fragment];
    if (!region) return;
    RegionSummary& summary = regions[region];
    const Eigen::Vector3f place(point.x, point.y, point.z);
    ++summary.voxels;
    summary.box_world.extend(place);
    sums.try_emplace(region, Eigen::Vector3d::Zero()).first->second += place.cast<double>();
  }));
  std::vector<RegionSummary> list;
  for (auto& [region, summary] : regions) {
    summary.region = region;
    summary.seen_from = table.seenFrom(region);
    summary.centroid_world = (sums.at(region) / static_cast<double>(summary.voxels)).cast<float>();
    summary.note = pipeline_->labels().editor().notes().of(region);
    summary.label = labelOf(region);
    summary.is_proposed_background =
        isProposedBackground(table.supportPixels(region), summary.note, summary.label);
    list.push_back(std::move(summary));
  }
  return list;
}

const SavedFrame* OpenSession::frameAt(int source_index) const {
  // With several recordings in one session, the newest.
  for (auto frame = scan_.frames.rbegin(); frame != scan_.frames.rend(); ++frame) {
    if (frame->source_index == source_index) return &*frame;
  }
  return nullptr;
}

const SavedFrame* OpenSession::frameOf(const SavedKeyFrame& key_frame) const {
  const auto found = std::ranges::find(scan_.frames, key_frame.frame, &SavedFrame::number);
  return found == scan_.frames.end() ? nullptr : &*found;
}

Result<OpenSession::SurfacePoint> OpenSession::at(int frame, int x, int y) {
  const SavedFrame* saved = frameAt(frame);
  const std::string called = "Frame " + std::to_string(frame) + " of " + folder_.string();
  if (saved == nullptr)
    return fail("There is no frame " + std::to_string(frame) + " in " + folder_.string() + ".",
                "session show says which frames there are.");
  if (!saved->isUsable()) return fail(called + " has no pose: the camera was lost.", "Name another frame.");
  const Intrinsics K = intrinsicsOf(*saved);
  if (x < 0 || y < 0 || x >= K.width || y >= K.height) {
    return fail("The pixel " + std::to_string(x) + "," + std::to_string(y) + " lies outside of the " +
                    std::to_string(K.width) + " x " + std::to_string(K.height) + " pixels of a frame.",
                "Count from 0,0 at the top left.");
  }
  const auto view = pipeline_->readout().renderView(saved->T_world_camera,
                                                    pipeline_->workingIntrinsicsOf(saved->intrinsics));
  if (!view) return fail(view.error());
  const auto column = static_cast<std::size_t>(x * view->K.width / K.width);
  const auto row = static_cast<std::size_t>(y * view->K.height / K.height);
  const std::size_t pixel = row * static_cast<std::size_t>(view->K.width) + column;
  const float z = view->depth().z_m.ptr<float>()[pixel];
  if (!(z > 0))
    return fail(
        called + " shows no surface of the map at " + std::to_string(x) + "," + std::to_string(y) + ".",
        "Point at something that was scanned.");
  const Eigen::Vector3f seen = K.backProject(static_cast<float>(x), static_cast<float>(y), z);
  SurfacePoint point{view->regions[pixel], saved->T_world_camera.cast<float>() * seen};
  const auto key = std::ranges::find(scan_.key_frames, saved->number, &SavedKeyFrame::frame);
  if (key == scan_.key_frames.end()) return point;
  const Result<std::optional<PaintedImage>> painted = PaintedImage::of(*this, *key);
  if (!painted) return fail(painted.error());
  if (*painted) point.region = (*painted)->regionAt(point.point_world, point.region);
  return point;
}

std::optional<Error> OpenSession::takeFailure() { return recorder_->takeFailure(); }

Result<void> OpenSession::findDisturbance() { return recorder_->findDisturbance(); }

void OpenSession::joinObjects(const RegionEditor::Outcome& outcome, EditDirection direction) {
  std::map<RegionId, ObjectId> objects = recorder_->objects();
  JoinedObjects joined = scantrove::joinObjects(outcome.events, objects);
  const std::string name = joinKeyOf(lastOperation(history(), direction == EditDirection::undone));
  if (direction == EditDirection::undone) {
    joined = joinedFrom(metadata(name));
    for (const auto& [region, object] : joined.before) objects[region] = object;
    joined.state = JoinedObjects::State::to_unmerge;
    if (joined.merges.empty()) joined = {};
  }
  if (const std::string text = joinedToText(joined); text != metadata(name)) setMetadata(name, text);
  recorder_->setObjects(std::move(objects));
}

Result<RegionEditor::Outcome> OpenSession::keep(Result<RegionEditor::Outcome> outcome,
                                                EditDirection direction) {
  if (!outcome) return outcome;
  joinObjects(*outcome, direction);
  if (isNaming(outcome->operation.kind))
    setMetadata(kObjectsKey, withoutRegions(metadata(kObjectsKey), outcome->operation.regions));
  const bool is_review = outcome->operation.kind == OperationKind::review;
  if (areResultsCurrent() && !is_review) setMetadata(kResultsKey, kResultsEdited);
  std::vector<CatalogueStep> steps;
  if (has_catalogue_ && !setup_.database.empty())
    steps = catalogueStepsOf(outcome->operation, direction,
                             [this](RegionId region) -> const RegionNote& { return noteOf(region); });
  if (!steps.empty()) {
    std::vector<PendingEdit> pending = pendingEdits();
    pending.push_back(pendingEditOf(std::move(steps)));
    setMetadata(kPendingEditsKey, pendingEditsToJson(pending));
  }
  SCANTROVE_TRY(saveMetadata());
  return outcome;
}

Result<RegionEditor::Outcome> OpenSession::edit(const Operation& operation) {
  if (operation.review && std::ranges::find(scan_.key_frames, operation.review->key_frame,
                                            &SavedKeyFrame::frame) == scan_.key_frames.end()) {
    return fail("No image of frame " + std::to_string(operation.review->image) + " was kept in " +
                    folder_.string() + ".",
                "'scantrove session review --list' lists the key frames.");
  }
  if (operation.kind == OperationKind::unpaint) {
    SCANTROVE_TRY(checkUnpaint(history(), pipeline_->labels().table(), operation));
  } else if (operation.kind != OperationKind::paint) {
    return keep(pipeline_->edit(operation), EditDirection::done);
  }
  const Result<std::optional<PaintedSurface>> painted = paintedSurfaceOf(*this, operation);
  if (!painted) return fail(painted.error());
  return keep(pipeline_->edit(operation, *painted ? &**painted : nullptr), EditDirection::done);
}

Result<RegionEditor::Outcome> OpenSession::undo() { return keep(pipeline_->undo(), EditDirection::undone); }

Result<RegionEditor::Outcome> OpenSession::redo() { return keep(pipeline_->redo(), EditDirection::redone); }

}  // namespace scantrove
