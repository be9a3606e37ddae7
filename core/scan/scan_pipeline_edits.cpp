// What a person says of regions while the frames go by, and the catalogue's side of it.
#include <algorithm>

#include "core/compute/guarded.h"
#include "core/discovery/region_candidate.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {

void ScanPipeline::leaveOutSaid(std::vector<Candidate>& candidates) const {
  const RegionNotes& notes = editor_->notes();
  if (notes.all().empty()) return;
  std::erase_if(candidates, [&](const Candidate& candidate) {
    const bool is_set = candidate.regions.size() > 1;
    const bool is_one = is_set && collector_ && collector_->areOneObject(candidate.regions);
    return std::ranges::any_of(candidate.regions, [&](RegionId region) {
      const RegionNote& note = notes.of(region);
      return note.background || note.rejected || (is_set && !is_one && !note.name.empty());
    });
  });
}

void ScanPipeline::addWanted(const DiscoveryInput& input, std::vector<Candidate>& candidates) const {
  if (!collector_) return;
  const double scale = static_cast<double>(input.view.K.pixels()) / (640.0 * 480.0);
  const auto least_points = static_cast<int>(params_.discovery.min_points * scale);
  for (const auto& [region, name] : collector_->requested()) {
    // What is named is the region alone; else what a person has clicked may be a part of a set.
    const bool is_found =
        std::ranges::any_of(candidates, [one = region, is_any = name.empty()](const Candidate& other) {
          return other.regions == RegionSet{one} || (is_any && other.regions.contains(one));
        });
    if (is_found) continue;
    if (std::optional<Candidate> candidate = candidateOf(region, input, least_points))
      candidates.push_back(std::move(*candidate));
  }
}

Result<RegionEditor::Outcome> ScanPipeline::edit(const Operation& operation) {
  Operation said = operation;
  said.frame = frames_;
  return guarded("editing the regions",
                 [&] { return finishEdit(editor_->apply(said, params_.labeling), Way::done); });
}

Result<RegionEditor::Outcome> ScanPipeline::undo() {
  return guarded("undoing", [&] { return finishEdit(editor_->undo(), Way::undone); });
}

Result<RegionEditor::Outcome> ScanPipeline::redo() {
  return guarded("doing it again", [&] { return finishEdit(editor_->redo(), Way::redone); });
}

Result<RegionEditor::Outcome> ScanPipeline::finishEdit(Result<RegionEditor::Outcome> outcome, Way way) {
  if (!outcome) return outcome;
  tellOf(outcome->events, ObjectCollector::JoinedBy::person);
  if (collector_) followSaying(*outcome, way);
  return outcome;
}

void ScanPipeline::followSaying(const RegionEditor::Outcome& outcome, Way way) {
  const Operation& operation = outcome.operation;
  if (isNaming(operation.kind) && !operation.name.empty()) {
    if (way == Way::done) {
      for (const RegionId region : operation.regions) collector_->nameByPerson(region, operation.name);
    } else if (way == Way::redone) {
      for (const RegionId region : operation.regions) collector_->nameAgain(region, operation.name);
    } else {
      for (auto region = operation.regions.rbegin(); region != operation.regions.rend(); ++region) {
        collector_->takeNameBack(*region, operation.name);
        // The name that it had before may have waited for the object until now.
        const std::string& name = editor_->notes().of(*region).name;
        if (!name.empty() && !collector_->hasNamed(*region, name)) collector_->nameByPerson(*region, name);
      }
    }
  }
  if (operation.kind == OperationKind::object && operation.on && way == Way::undone) {
    for (const RegionId region : operation.regions) collector_->takeObjectBack(region);
  }
  std::vector<RegionId> regions = operation.regions;
  regions.insert(regions.end(), outcome.regions.begin(), outcome.regions.end());
  const bool is_said = isNaming(operation.kind) || operation.kind == OperationKind::object ||
                       operation.kind == OperationKind::background || operation.kind == OperationKind::reject;
  for (const RegionId region : regions) {
    if (!wantAsSaid(region) && (is_said || way == Way::undone)) collector_->wantNoMore(region);
  }
}

bool ScanPipeline::wantAsSaid(RegionId region) {
  const RegionNote& note = editor_->notes().of(region);
  const bool is_thing = (note.object || !note.name.empty()) && !note.background && !note.rejected;
  if (!is_thing || table_.fragmentsOf(region).empty()) return false;
  collector_->want(region, note.name);
  return true;
}

std::map<RegionId, RegionLabel> ScanPipeline::labels() const {
  std::map<RegionId, RegionObject> objects;
  std::map<RegionId, RegionLabel> labels;
  for (const RegionId region : table_.regions()) {
    if (!region || labels.contains(region)) continue;
    const RegionObject& object = objects[region] =
        collector_ ? collector_->describeRegion(region) : RegionObject{};
    labels[region] = labelOf(editor_->notes().of(region), object);
  }
  shareClasses(labels, objects);
  return labels;
}

void ScanPipeline::wantAsSaid() {
  if (!collector_) return;
  for (const auto& [region, note] : editor_->notes().all()) wantAsSaid(region);
}

Result<void> ScanPipeline::addWantedAtEnd(const std::function<void(const FrameObjects&)>& announce) {
  if (!last_seen_ || collector_->requested().empty()) return {};
  const Result<RenderedView> view = renderView(last_seen_->T_world_camera);
  if (!view) return fail(view.error());
  std::vector<Candidate> candidates;
  addWanted({*view}, candidates);
  const SurfaceInColor in_color =
      locateInColor(last_seen_->frame.color_camera, view->K, view->T_world_camera, view->vertices_world);
  announce(collector_->addWanted(last_seen_->frame, view->T_world_camera, in_color, candidates));
  return {};
}

Result<void> ScanPipeline::finishCatalogue(const std::function<void(const FrameObjects&)>& announce) {
  if (!collector_) return {};
  // A device that failed keeps nothing from being stored that was found before.
  Result<void> added = guarded("adding what was named last", [&] { return addWantedAtEnd(announce); });
  SCANTROVE_TRY(collector_->finish(announce));
  return added;
}

}  // namespace scantrove
