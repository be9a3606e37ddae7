#include "core/scan/open_session.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "core/catalog/object_database.h"
#include "core/compute/compute_context.h"
#include "core/scan/catalogue_numbers.h"
#include "core/scan/scan_pipeline.h"
#include "core/scan/session_recorder.h"
#include "core/scan/session_restorer.h"

namespace scantrove {

OpenSession::OpenSession(std::filesystem::path folder) : folder_(std::move(folder)) {}

OpenSession::~OpenSession() = default;

const OperationLog& OpenSession::history() const { return pipeline_->editor().log(); }

const RegionNote& OpenSession::noteOf(RegionId region) const {
  return pipeline_->editor().notes().of(region);
}

ObjectId OpenSession::objectOf(RegionId region) const { return recorder_->objectOf(region); }

Result<void> OpenSession::setObject(RegionId region, ObjectId object) {
  recorder_->setObject(region, object);
  return recorder_->save(*pipeline_);
}

std::string OpenSession::fact(const std::string& name) const {
  const auto found = scan_.facts.find(name);
  return found == scan_.facts.end() ? std::string() : found->second;
}

Result<bool> OpenSession::useCatalogue(ObjectDatabase& database) {
  const Result<CatalogueIdentity> identity = identityOf(database, scan_.facts);
  if (!identity) return fail(identity.error());
  CatalogueNumbers numbers{scan_.facts, recorder_->objects()};
  const bool is_other = turnTo(numbers, *identity);
  for (const auto& [name, value] : numbers.facts) {
    if (fact(name) != value) setFact(name, value);
  }
  recorder_->setObjects(std::move(numbers.objects));
  return is_other;
}

void OpenSession::checkCatalogue() {
  const std::filesystem::path file = databaseFileOf(setup_, folder_);
  std::error_code ignored;
  if (file.empty() || !std::filesystem::is_regular_file(file, ignored)) return;
  const auto database = ObjectDatabase::openToRead(file.string());
  if (!database) return;  // whoever needs it says why it cannot be used
  const Result<bool> is_other = useCatalogue(**database);
  if (is_other && *is_other) damages_.push_back(isAnotherCatalogue(folder_, file.string()).message());
}

void OpenSession::setFact(const std::string& name, const std::string& value) {
  scan_.facts[name] = value;
  recorder_->setFact(name, value);
}

int OpenSession::brickCount() const { return pipeline_->bricks().brickCount(); }

Result<std::unique_ptr<OpenSession>> OpenSession::open(const std::filesystem::path& folder,
                                                       const std::string& device) {
  std::unique_ptr<OpenSession> session(new OpenSession(folder));
  std::unique_ptr<SessionWriter> writer;
  SCANTROVE_TRY(moveInto(writer, SessionWriter::start(folder, SessionWriter::Way::open)));
  SCANTROVE_TRY(moveInto(session->scan_, loadScan(*writer, session->damages_)));
  SCANTROVE_TRY(moveInto(session->setup_, setupFrom(session->scan_.facts)));
  SCANTROVE_TRY(moveInto(session->compute_, ComputeContext::create({.device = device})));
  SCANTROVE_TRY(moveInto(
      session->pipeline_,
      ScanPipeline::create(*session->compute_, {.K = session->setup_.K, .params = session->setup_.params})));
  SCANTROVE_TRY(restoreScan(*session->pipeline_, *writer, session->scan_, false, session->damages_));
  session->recorder_ = SessionRecorder::resume(std::move(writer), *session->pipeline_, session->scan_, false);
  session->checkCatalogue();
  return session;
}

Result<std::vector<RegionSummary>> OpenSession::regions() {
  std::map<RegionId, RegionSummary> regions;
  std::map<RegionId, Eigen::Vector3d> sums;
  const RegionTable& table = pipeline_->regionTable();
  SCANTROVE_TRY(pipeline_->forEachCloudPoint([&](const LabelPoint& point) {
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
    summary.object = objectOf(region);
    summary.seen_from = table.seenFrom(region);
    summary.centroid_world = (sums.at(region) / static_cast<double>(summary.voxels)).cast<float>();
    summary.note = pipeline_->editor().notes().of(region);
    list.push_back(std::move(summary));
  }
  return list;
}

const SavedFrame* OpenSession::frameAt(int source_index) const {
  // Of several recordings in one session the newest.
  for (auto frame = scan_.frames.rbegin(); frame != scan_.frames.rend(); ++frame) {
    if (frame->source_index == source_index) return &*frame;
  }
  return nullptr;
}

const SavedFrame* OpenSession::frameOf(const SavedKeyFrame& key_frame) const {
  const auto found = std::ranges::find(scan_.frames, key_frame.frame, &SavedFrame::number);
  return found == scan_.frames.end() ? nullptr : &*found;
}

Result<OpenSession::Place> OpenSession::at(int frame, int x, int y) {
  const SavedFrame* saved = frameAt(frame);
  const std::string called = "Frame " + std::to_string(frame) + " of " + folder_.string();
  if (saved == nullptr)
    return fail("There is no frame " + std::to_string(frame) + " in " + folder_.string() + ".",
                "session show says which frames there are.");
  if (!saved->isUsable()) return fail(called + " has no pose: the camera was lost.", "Name another frame.");
  const Intrinsics& K = setup_.K;
  if (x < 0 || y < 0 || x >= K.width || y >= K.height) {
    return fail("The pixel " + std::to_string(x) + "," + std::to_string(y) + " lies outside of the " +
                    std::to_string(K.width) + " x " + std::to_string(K.height) + " pixels of a frame.",
                "Count from 0,0 at the top left.");
  }
  const auto view = pipeline_->lookAtMap(saved->T_world_camera);
  if (!view) return fail(view.error());
  const auto column = static_cast<std::size_t>(x * view->width / K.width);
  const auto row = static_cast<std::size_t>(y * view->height / K.height);
  const std::size_t pixel = row * static_cast<std::size_t>(view->width) + column;
  const float z = view->depths_m[pixel];
  if (!(z > 0))
    return fail(
        called + " shows no surface of the map at " + std::to_string(x) + "," + std::to_string(y) + ".",
        "Point at something that was scanned.");
  const Eigen::Vector3f seen = K.backProject(static_cast<float>(x), static_cast<float>(y), z);
  return Place{view->regions[pixel], saved->T_world_camera.cast<float>() * seen};
}

Result<RegionEditor::Outcome> OpenSession::keep(Result<RegionEditor::Outcome> outcome) {
  if (!outcome) return outcome;
  SCANTROVE_TRY(recorder_->save(*pipeline_));
  return outcome;
}

Result<RegionEditor::Outcome> OpenSession::edit(const Operation& operation) {
  return keep(pipeline_->edit(operation));
}

Result<RegionEditor::Outcome> OpenSession::undo() { return keep(pipeline_->undo()); }

Result<RegionEditor::Outcome> OpenSession::redo() { return keep(pipeline_->redo()); }

}  // namespace scantrove
