#include "core/scan/scan_objects.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/catalogue/stored_namings.h"
#include "core/compute/guarded.h"
#include "core/fusion/color_projection.h"
#include "core/refinement/collector_input.h"

namespace scantrove {

Result<FrameObjects> ScanObjects::addFrame(const RgbdFrame& frame, const FrameResult& result) {
  if (!result.pose.usable()) return FrameObjects{};
  const auto add = [&]() -> Result<FrameObjects> {
    applyRegionEvents(*collector_, result.region_events, ObjectCollector::JoinedBy::frames);
    std::vector<Candidate> candidates = candidatesFor(
        *collector_, result, pipeline_.labels().editor().notes(), pipeline_.params().discovery.min_points);
    FrameObjects objects = pipeline_.timer().time("detect", [&] {
      return collector_->collect(frame, result.pose.T_world_camera, result.observed.in_color,
                                 std::move(candidates));
    });
    keepKnown(objects);
    collector_->checkPlaces(result.observed.depth, pipeline_.params().fusion.depth_noise_m);
    // The last one with colour, if any has it: views of objects need it.
    if (!last_seen_ || last_seen_->frame.color.empty() || !frame.color.empty())
      last_seen_ = {frame, result.pose.T_world_camera};
    return objects;
  };
  return guarded("in frame " + std::to_string(frame.index), add);
}

void ScanObjects::keepKnown(const FrameObjects& objects) {
  using Known = MapLabels::Known;
  for (const SeenObject& seen : objects.seen) {
    // A confirmed object is one thing, whatever number of regions it was found as.
    pipeline_.labels().setKnown(
        seen.regions, seen.confirmed ? Known::one_object : (seen.recognized ? Known::yes : Known::no));
  }
}

void ScanObjects::applyEdit(const RegionEditor::Outcome& outcome, EditDirection direction) {
  const int number = lastOperation(pipeline_.labels().editor().log(), direction == EditDirection::undone);
  if (direction == EditDirection::undone) {
    ScanJoins::Undone undone = joins_.remove(number);
    applyRegionEvents(*collector_, outcome.events, ObjectCollector::JoinedBy::user);
    if (!undone.objects.empty()) collector_->partRegions(number, undone.objects, std::move(undone.earlier));
  } else {
    joins_.add(number, outcome.events, collector_->objects());
    applyRegionEvents(*collector_, outcome.events, ObjectCollector::JoinedBy::user, number);
  }
  const Operation& operation = outcome.operation;
  if (isNaming(operation.kind) && !operation.name.empty()) applyNames(operation, direction);
  if (operation.kind == OperationKind::object && operation.on && direction == EditDirection::undone) {
    for (const RegionId region : operation.regions) collector_->requests().undoObject(region);
  }
  std::vector<RegionId> regions = operation.regions;
  regions.insert(regions.end(), outcome.regions.begin(), outcome.regions.end());
  const bool is_label = isNaming(operation.kind) || operation.kind == OperationKind::object ||
                        operation.kind == OperationKind::background ||
                        operation.kind == OperationKind::reject;
  for (const RegionId region : regions) {
    if (!requestNoted(region) && (is_label || direction == EditDirection::undone))
      collector_->requests().cancel(region);
  }
}

void ScanObjects::applyNames(const Operation& operation, EditDirection direction) {
  const GivenName given{operation.name, operation.category};
  if (direction == EditDirection::done) {
    for (const RegionId region : operation.regions) collector_->requests().name(region, given);
  } else if (direction == EditDirection::redone) {
    for (const RegionId region : operation.regions) collector_->requests().redoName(region, given);
  } else {
    for (auto region = operation.regions.rbegin(); region != operation.regions.rend(); ++region) {
      collector_->requests().undoName(*region, operation.name);
      // The previous name may have waited for the object until now.
      const RegionNote& note = pipeline_.labels().editor().notes().of(*region);
      if (!note.name.empty() && !collector_->requests().hasNamed(*region, note.name))
        collector_->requests().name(*region, {note.name, note.category});
    }
  }
}

bool ScanObjects::requestNoted(RegionId region) {
  const RegionNote& note = pipeline_.labels().editor().notes().of(region);
  const bool is_object = (note.object || !note.name.empty()) && !note.background && !note.rejected;
  if (!is_object || pipeline_.labels().table().fragmentsOf(region).empty()) return false;
  collector_->requests().request(region, {note.name, note.category});
  return true;
}

void ScanObjects::restore(const SavedScan& scan) {
  for (const SavedRegion& region : scan.regions) {
    if (collector_->objects().idOf(region.region) != region.object)
      collector_->bind(region.region, region.object);
    if (const auto namings = scan.metadata.find(namingsKeyOf(region.region)); namings != scan.metadata.end())
      collector_->requests().restoreNamings(region.region, namingsFromJson(namings->second));
  }
  joins_.restore(scan.metadata, collector_->objects());
  for (const auto& [region, note] : pipeline_.labels().editor().notes().all()) requestNoted(region);
}

std::map<RegionId, RegionLabel> ScanObjects::labels() const {
  std::map<RegionId, RegionObject> objects;
  std::map<RegionId, RegionLabel> labels;
  for (const RegionId region : pipeline_.labels().table().regions()) {
    if (!region || labels.contains(region)) continue;
    const RegionObject& object = objects[region] = collector_->objects().describe(region);
    labels[region] = labelOf(pipeline_.labels().editor().notes().of(region), object);
  }
  shareClasses(labels, objects);
  return labels;
}

Result<void> ScanObjects::addRequestedAtEnd(const std::function<void(const FrameObjects&)>& announce) {
  if (!last_seen_ || collector_->requests().pending().empty()) return {};
  const Intrinsics K = pipeline_.workingIntrinsicsOf(last_seen_->frame.intrinsics);
  const Result<RenderedView> view = pipeline_.readout().renderView(last_seen_->T_world_camera, K);
  if (!view) return fail(view.error());
  std::vector<Candidate> candidates;
  addRequested(*collector_, {*view}, pipeline_.params().discovery.min_points, candidates);
  const SurfaceInColor in_color = locateInColor(last_seen_->frame.color_camera, *view);
  announce(collector_->addRequested(last_seen_->frame, view->T_world_camera, in_color, candidates));
  return {};
}

Result<void> ScanObjects::finish(const std::function<void(const FrameObjects&)>& announce) {
  // After a device failure everything found before is still stored.
  Result<void> added = guarded("adding what was named last", [&] { return addRequestedAtEnd(announce); });
  SCANTROVE_TRY(collector_->finish(announce));
  return added;
}

}  // namespace scantrove
