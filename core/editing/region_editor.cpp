#include "core/editing/region_editor.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/editing/region_painter.h"
#include "core/editing/stroke_surroundings.h"
#include "core/editing/surface_split.h"
#include "core/labeling/region_partition.h"

namespace scantrove {
namespace {

/// Radius around a given place whose voxels belong to it.
constexpr float kPointed_m = 0.012F;
/// finer: lowers the borders' log-odds, up to kLessTimes, until the region splits; then halves k, up to
/// kHalvings times, first along folds alone. Colours, which vary more, are cut with kColorTimes that k.
constexpr float kFirstLess = 0.5F;
constexpr int kLessTimes = 6;
constexpr float kFirstThreshold = 0.3F;
constexpr int kHalvings = 10;
constexpr float kColorTimes = 3;

std::string called(RegionId region) { return "region " + std::to_string(region.value); }

/// True if the operation joins regions.
bool isJoining(OperationKind kind) { return kind == OperationKind::join || kind == OperationKind::coarser; }

/// True if a cut separates its only strokes from what surrounds them.
bool isBySurroundings(const Operation& cut) { return cut.there_world.empty(); }

/// Pairs (into, from) of a join. Its moves may be incomplete, because a region's only fragment may be gone.
std::set<std::pair<RegionId, RegionId>> joinedBy(const OperationLog::Entry& entry) {
  std::set<std::pair<RegionId, RegionId>> joined;
  for (const RegionMove& move : entry.effect.moves) joined.emplace(move.after, move.before);
  const std::vector<RegionId>& regions = entry.operation.regions;
  for (const RegionId region : regions) {
    if (region != regions.front()) joined.emplace(regions.front(), region);
  }
  return joined;
}

}  // namespace

Result<RegionEditor::Outcome> RegionEditor::apply(const Operation& given, const LabelingParams& params,
                                                  const PaintedSurface* painted) {
  const Result<Operation> checked = withCheckedNames(given);
  if (!checked) return fail(checked.error());
  const Operation& operation = *checked;
  if (operation.kind == OperationKind::review && operation.review) {
    log_.add(operation, {});
    return Outcome{{}, {}, operation};
  }
  if (operation.regions.empty()) return fail("An operation names no region.", "Say which region is meant.");
  for (const RegionId region : operation.regions) {
    if (!exists(region)) {
      return fail("There is no " + called(region) + " (any more).",
                  "List the regions anew: numbers change as regions join.");
    }
  }
  Work work{operation, params, painted, {}, {}, {}};
  for (const RegionId region : operation.regions) remember(region, work);
  SCANTROVE_TRY(run(work));
  for (const auto& [fragment, before] : work.before) {
    const RegionId after = table_.regionOf(fragment);
    if (after != before) work.effect.moves.push_back({fragment, before, after});
  }
  log_.add(operation, std::move(work.effect));
  work.outcome.operation = operation;
  return std::move(work.outcome);
}

Result<void> RegionEditor::run(Work& work) {
  switch (work.operation.kind) {
    case OperationKind::join:
      return join(work, work.operation.regions);
    case OperationKind::cut:
      return cut(work);
    case OperationKind::finer:
      return finer(work);
    case OperationKind::coarser:
      return coarser(work);
    case OperationKind::paint:
    case OperationKind::unpaint:
      return paint(work);
    case OperationKind::name:
    case OperationKind::accept:
    case OperationKind::background:
    case OperationKind::object:
    case OperationKind::reject:
    case OperationKind::review:
      break;
  }
  return note(work);
}

Result<void> RegionEditor::note(Work& work) {
  for (const RegionId region : work.operation.regions)
    write(work, region, notedBy(work.operation, notes_.of(region)));
  work.outcome.regions = work.operation.regions;
  return {};
}

Result<void> RegionEditor::join(Work& work, const std::vector<RegionId>& regions) {
  std::vector<RegionId> different;
  for (const RegionId region : regions) {
    if (std::ranges::find(different, region) == different.end()) different.push_back(region);
  }
  if (different.size() < 2) return fail("A join takes two regions or more.", "Say which are one thing.");
  const RegionId into = different.front();
  for (const RegionId from : std::span(different).subspan(1)) {
    const FragmentId a = editable().largestOf(table_.fragmentsOf(into));
    const FragmentId b = editable().largestOf(table_.fragmentsOf(from));
    write(work, into, joinedNote(notes_.of(into), notes_.of(from)));
    table_.join(into, from);
    work.outcome.events.joined.emplace_back(into, from);
    editable().constrain(a, b, LinkConstraint::must_link, work.effect);
  }
  work.outcome.regions = {into};
  return {};
}

Result<void> RegionEditor::cut(Work& work) {
  const RegionId region = work.operation.regions.front();
  const auto fragments = table_.fragmentsOf(region);
  std::vector<Eigen::Vector3f> places = work.operation.here_world;
  places.insert(places.end(), work.operation.there_world.begin(), work.operation.there_world.end());
  const SurfaceGraph graph = SurfaceGraph::of(map_.surfaceOf(fragments, places));
  const auto voxelsAt = [&](const std::vector<Eigen::Vector3f>& at) {
    std::set<std::uint32_t> voxels;
    for (const Eigen::Vector3f& place : at) {
      const auto around = graph.around(place, map_.voxelSize(), kPointed_m);
      voxels.insert(around.begin(), around.end());
    }
    return std::vector<std::uint32_t>(voxels.begin(), voxels.end());
  };
  const std::vector<std::uint32_t> here = voxelsAt(work.operation.here_world);
  std::vector<std::uint32_t> there =
      isBySurroundings(work.operation) ? surroundingsOf(graph, here) : voxelsAt(work.operation.there_world);
  std::erase_if(there, [&](std::uint32_t voxel) { return std::ranges::binary_search(here, voxel); });
  if (here.empty() || there.empty()) {
    return isBySurroundings(work.operation)
               ? fail("Nothing around the stroke on " + called(region) + " differs from it in colour.",
                      "Draw a second stroke over the part that stays.")
               : fail("The two places of the cut are one place of " + called(region) + ".",
                      "Point at two places that lie farther apart.");
  }
  const bool is_reversed = isBySurroundings(work.operation);  // what nothing connects stays with the rest
  const auto side = is_reversed ? splitSurface(graph, there, here) : splitSurface(graph, here, there);
  const auto parts =
      editable().divideVoxels(region, graph, std::vector<std::uint32_t>(side.begin(), side.end()), 2).parts;
  divide(work, parts);
  work.outcome.regions = {table_.regionOf(parts[0].front()), table_.regionOf(parts[1].front())};
  if (is_reversed) std::swap(work.outcome.regions[0], work.outcome.regions[1]);
  return {};
}

Result<void> RegionEditor::finer(Work& work) {
  const RegionId region = work.operation.regions.front();
  const auto isPart = [regions = editable()](const Fragments& fragments) {
    int voxels = 0;
    for (const FragmentId fragment : fragments) voxels += regions.voxelsOf(fragment);
    return voxels >= kSmallFragmentVoxels;
  };
  float less = kFirstLess;
  for (int i = 0; i < kLessTimes; ++i, less *= 2) {
    std::vector<Fragments> parts =
        merger_->partsOf(region, less, table_, map_.voxelsOfFragments(), work.params);
    if (std::ranges::count_if(parts, isPart) < 2) continue;
    divide(work, parts);
    return {};
  }
  const SurfaceGraph graph =
      SurfaceGraph::of(map_.surfaceOf(table_.fragmentsOf(region), work.operation.here_world));
  float k = kFirstThreshold;
  for (int i = 0; i < kHalvings; ++i, k /= 2) {
    for (const auto& [cues, times] :
         {std::pair(SurfaceCues::folds, 1.0F), std::pair(SurfaceCues::folds_and_colors, kColorTimes)}) {
      if (cues == SurfaceCues::folds_and_colors && graph.tints.empty()) continue;
      const auto part = segmentSurface(graph, times * k, kSmallFragmentVoxels, cues);
      const std::size_t parts = part.empty() ? 0 : *std::ranges::max_element(part) + std::size_t{1};
      if (parts < 2) continue;
      divide(work, editable().divideVoxels(region, graph, part, parts).parts);
      return {};
    }
  }
  return fail("Nothing splits " + called(region) + " further.", "Split it between two strokes or points.");
}

Result<void> RegionEditor::coarser(Work& work) {
  const RegionId region = work.operation.regions.front();
  std::set<RegionId> neighbors;
  for (const FragmentId fragment : table_.fragmentsOf(region)) {
    for (const FragmentId other : merger_->neighborsOf(fragment)) neighbors.insert(table_.regionOf(other));
  }
  neighbors.erase(region);
  neighbors.erase(RegionId{});
  RegionId likeliest;
  float best = 0;
  for (const RegionId neighbor : neighbors) {
    const auto odds = merger_->joiningOdds(region, neighbor, table_, map_.voxelsOfFragments(), work.params);
    if (!odds || (likeliest && *odds <= best)) continue;
    best = *odds;
    likeliest = neighbor;
  }
  if (!likeliest) {
    return fail("Nothing was seen to touch " + called(region) + ".", "Join it by naming the other region.");
  }
  remember(likeliest, work);
  return join(work, {region, likeliest});
}

Result<void> RegionEditor::paint(Work& work) {
  work.before.clear();  // the painter knows them
  RegionPainter painter(editable());
  RegionId region;
  SCANTROVE_TRY(
      moveInto(region, painter.apply(work.operation, work.painted, work.effect, work.outcome.events)));
  for (const auto& [into, from] : work.outcome.events.joined) {
    if (notes_.of(into) == RegionNote{}) write(work, into, notes_.of(from));
  }
  work.outcome.regions = {region};
  for (const RegionId changed : painter.changed()) {
    if (changed != region && exists(changed)) work.outcome.regions.push_back(changed);
  }
  return {};
}

void RegionEditor::remember(RegionId region, Work& work) const {
  for (const FragmentId fragment : table_.fragmentsOf(region)) work.before.emplace_back(fragment, region);
}

void RegionEditor::divide(Work& work, const std::vector<Fragments>& parts) {
  // An undo must return fragments that were split just now to their region.
  const RegionId region = work.operation.regions.front();
  for (const Fragments& part : parts) {
    for (const FragmentId fragment : part) {
      if (std::ranges::find(work.before, std::pair(fragment, region)) == work.before.end())
        work.before.emplace_back(fragment, region);
    }
  }
  table_.divide(parts, map_.voxelsOfFragments(), work.outcome.events);
  for (const Fragments& part : parts) work.outcome.regions.push_back(table_.regionOf(part.front()));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size(); ++j) editable().keepApart(parts[i], parts[j], work.effect);
  }
}

void RegionEditor::write(Work& work, RegionId region, const RegionNote& note) {
  const RegionNote before = notes_.of(region);
  if (note == before) return;
  work.effect.notes.push_back({region, before, note});
  setNote(region, note);
}

void RegionEditor::setNote(RegionId region, const RegionNote& note) {
  notes_.set(region, note);
  table_.setUserLabel(region, userLabelOf(note));
}

void RegionEditor::takeInNewFragments(const OperationLog::Entry& entry, bool is_undo) {
  // A join moves complete regions. Undoing a cut moves complete parts, except the one that kept the region's
  // identity.
  const bool is_joining = isJoining(entry.operation.kind);
  if (is_joining == is_undo) return;
  OperationEffect more;
  const auto moveWhole = [&](RegionId region, RegionId before, RegionId after) {
    for (const FragmentId fragment : table_.fragmentsOf(region)) {
      if (std::ranges::find(entry.effect.moves, fragment, &RegionMove::fragment) == entry.effect.moves.end())
        more.moves.push_back({fragment, before, after});
    }
  };
  if (is_joining) {
    for (const auto& [into, from] : joinedBy(entry)) moveWhole(from, from, into);
  } else {
    std::map<RegionId, RegionId> parts;  // part -> its former region
    const std::vector<RegionId>& created = entry.effect.created;
    for (const RegionMove& move : entry.effect.moves) {
      // A painting also moves parts of regions to others, which stay.
      const bool is_part = entry.operation.kind != OperationKind::paint ||
                           std::ranges::find(created, move.after) != created.end();
      if (is_part) parts.emplace(move.after, move.before);
    }
    for (const auto& [part, region] : parts) {
      if (part != entry.operation.regions.front()) moveWhole(part, region, part);
    }
  }
  if (!more.moves.empty()) log_.extend(entry.number, more);
}

void RegionEditor::holdTogether(const OperationLog::Entry& entry) {
  if (!isJoining(entry.operation.kind)) return;
  OperationEffect more;
  for (const auto& [into, from] : joinedBy(entry)) {
    if (!exists(into) || !exists(from)) continue;
    const bool is_linked =
        std::ranges::any_of(entry.effect.constraints, [&, into = into, from = from](const auto& constraint) {
          const RegionId a = table_.regionOf(constraint.a), b = table_.regionOf(constraint.b);
          return constraint.after == LinkConstraint::must_link &&
                 ((a == into && b == from) || (a == from && b == into));
        });
    if (is_linked) continue;
    const FragmentId a = editable().largestOf(table_.fragmentsOf(into));
    const FragmentId b = editable().largestOf(table_.fragmentsOf(from));
    more.constraints.push_back({a, b, merger_->constraintBetween(a, b), LinkConstraint::must_link});
  }
  if (!more.constraints.empty()) log_.extend(entry.number, more);
}

Result<RegionEditor::Outcome> RegionEditor::undo() {
  const OperationLog::Entry* entry = log_.undo();
  if (entry == nullptr) return fail("There is nothing to undo.", "");
  takeInNewFragments(*entry, true);
  const OperationEffect& effect = entry->effect;
  Outcome outcome;
  std::vector<RegionMove> back;
  for (const RegionMove& move : effect.moves) back.push_back({move.fragment, move.after, move.before});
  table_.move(back, outcome.events);
  for (const auto& constraint : effect.constraints)
    merger_->constrain(constraint.a, constraint.b, constraint.before);
  for (const auto& note : effect.notes) setNote(note.region, note.before);
  // Restored regions get their former labels.
  for (const RegionMove& move : effect.moves)
    table_.setUserLabel(move.before, userLabelOf(notes_.of(move.before)));
  outcome.regions = entry->operation.regions;
  outcome.operation = entry->operation;
  return outcome;
}

Result<RegionEditor::Outcome> RegionEditor::redo() {
  const OperationLog::Entry* entry = log_.redo();
  if (entry == nullptr) return fail("There is nothing to do again.", "");
  takeInNewFragments(*entry, false);
  holdTogether(*entry);
  const OperationEffect& effect = entry->effect;
  Outcome outcome;
  table_.move(effect.moves, outcome.events);
  for (const auto& constraint : effect.constraints)
    merger_->constrain(constraint.a, constraint.b, constraint.after);
  for (const auto& note : effect.notes) setNote(note.region, note.after);
  for (const RegionMove& move : effect.moves)
    table_.setUserLabel(move.after, userLabelOf(notes_.of(move.after)));
  outcome.regions = entry->operation.regions;
  outcome.operation = entry->operation;
  return outcome;
}

}  // namespace scantrove
