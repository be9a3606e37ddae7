#include "core/refinement/continued_background.h"

#include <algorithm>
#include <optional>
#include <set>

namespace scantrove {

ContinuedBackground::ContinuedBackground(const Regions& regions, RegionId last_known) {
  for (const auto& [region, note] : regions.notes.all()) {
    if (note.background && !regions.table.fragmentsOf(region).empty()) marked_.try_emplace(region);
  }
  if (marked_.empty()) return;
  std::set<RegionId> edited;
  for (const OperationLog::Entry& entry : regions.log.entries())
    edited.insert(entry.operation.regions.begin(), entry.operation.regions.end());
  for (const RegionId region : regions.table.regions()) {
    if (region <= last_known || edited.contains(region) || supports_.contains(region)) continue;
    const auto label = regions.labels.find(region);
    if (isProposedBackground(regions.table.supportPixels(region), regions.notes.of(region),
                             label == regions.labels.end() ? RegionLabel{} : label->second))
      supports_.try_emplace(region);
  }
}

void ContinuedBackground::add(RegionId region, const Eigen::Vector3f& point_world,
                              const Eigen::Vector3f& normal_world) {
  for (std::map<RegionId, SurfaceCells>* const of : {&marked_, &supports_}) {
    if (const auto found = of->find(region); found != of->end()) found->second.add(point_world, normal_world);
  }
}

std::vector<RegionId> ContinuedBackground::find() const {
  std::vector<PlanarPart> marked;
  for (const auto& [region, cells] : marked_) {
    if (std::optional<PlanarPart> part = cells.planarPart()) marked.push_back(std::move(*part));
  }
  std::vector<RegionId> found;
  for (const auto& [region, cells] : supports_) {
    const std::optional<PlanarPart> part = cells.planarPart();
    if (part && std::ranges::any_of(marked, [&](const auto& of) { return continuesInPlane(of, *part); }))
      found.push_back(region);
  }
  return found;
}

}  // namespace scantrove
