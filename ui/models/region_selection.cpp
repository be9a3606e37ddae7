#include "ui/models/region_selection.h"

#include <algorithm>
#include <functional>
#include <map>

namespace scantrove {
namespace {

/// Smaller regions are skipped.
constexpr std::int64_t kMinVoxels = 200;

}  // namespace

void RegionSelection::update(const ScanSnapshot& snapshot) {
  applyChanges(snapshot.changed_regions);
  if (snapshot.region_infos == nullptr) return;
  infos_ = snapshot.region_infos;
  bool moved = false;
  for (std::size_t i = 0; i < selected_.size(); ++i) {
    if (info(selected_[i]) != nullptr) continue;
    selected_[i] = currentRegionOf(fragments_[i]);
    moved = true;
  }
  if (moved) {
    std::vector<RegionId> remaining;
    for (const RegionId region : selected_) {
      if (region && std::ranges::find(remaining, region) == remaining.end()) remaining.push_back(region);
    }
    selected_ = std::move(remaining);
    emit selectionChanged();
  }
  storeFragments();
  emit infosChanged();
}

void RegionSelection::applyChanges(const std::vector<RegionChange>& changes) {
  for (const auto& [fragment, region, by_person] : changes) {
    if (fragment.value >= region_of_.size()) region_of_.resize(fragment.value + std::size_t{1});
    region_of_[fragment.value] = region;
  }
}

void RegionSelection::reset() {
  infos_ = std::make_shared<RegionInfos>();
  region_of_.clear();
  fragments_.clear();
  hovered_ = {};
  selected_.clear();
  visited_.clear();
  emit hoverChanged();
  emit selectionChanged();
  emit infosChanged();
}

void RegionSelection::hover(RegionId region) {
  if (region == hovered_) return;
  hovered_ = region;
  emit hoverChanged();
}

void RegionSelection::select(RegionId region, bool also) {
  std::vector<RegionId> regions = also ? selected_ : std::vector<RegionId>{};
  if (region && std::erase(regions, region) == 0) regions.push_back(region);
  select(regions);
}

void RegionSelection::select(const std::vector<RegionId>& regions) {
  if (regions == selected_) return;
  selected_ = regions;
  storeFragments();
  emit selectionChanged();
}

void RegionSelection::selectBySize(bool forward) {
  const auto exists = [this](RegionId region) { return info(region) != nullptr; };
  std::erase_if(visited_, std::not_fn(exists));
  if (!forward) {
    if (visited_.size() > 1) visited_.pop_back();
    if (!visited_.empty()) select(visited_.back());
    return;
  }
  const RegionInfo* largest = nullptr;
  bool any = false;
  for (const RegionInfo& region : *infos_) {
    if (region.voxels < kMinVoxels || region.note.background) continue;
    any = true;
    if (std::ranges::find(visited_, region.region) != visited_.end()) continue;
    if (largest == nullptr || region.voxels > largest->voxels) largest = &region;
  }
  if (largest != nullptr) {
    visited_.push_back(largest->region);
    select(largest->region);
  } else if (any) {
    visited_.clear();
    selectBySize(true);
  }
}

bool RegionSelection::isSelected(RegionId region) const {
  return std::ranges::find(selected_, region) != selected_.end();
}

const RegionInfo* RegionSelection::info(RegionId region) const { return find(*infos_, region); }

std::set<RegionId> RegionSelection::background() const {
  std::set<RegionId> regions;
  for (const RegionInfo& region : *infos_) {
    if (region.note.background) regions.insert(region.region);
  }
  return regions;
}

std::vector<RegionId> RegionSelection::proposedBackground() const {
  std::vector<RegionId> regions;
  for (const RegionInfo& region : *infos_) {
    if (region.is_proposed_background) regions.push_back(region.region);
  }
  return regions;
}

QString RegionSelection::title(RegionId region) const {
  const RegionInfo* const known = info(region);
  if (known != nullptr && !known->name().empty()) return QString::fromStdString(known->name());
  return titleWithoutName(region);
}

RegionId RegionSelection::currentRegionOf(const std::vector<FragmentId>& fragments) const {
  std::map<RegionId, int> votes;
  for (const FragmentId fragment : fragments) {
    if (fragment.value < region_of_.size() && region_of_[fragment.value]) ++votes[region_of_[fragment.value]];
  }
  const auto most = std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second; });
  return most == votes.end() ? RegionId{} : most->first;
}

void RegionSelection::storeFragments() {
  fragments_.assign(selected_.size(), {});
  if (selected_.empty()) return;
  for (std::uint32_t fragment = 1; fragment < region_of_.size(); ++fragment) {
    const auto found = std::ranges::find(selected_, region_of_[fragment]);
    if (found != selected_.end())
      fragments_[static_cast<std::size_t>(found - selected_.begin())].push_back(FragmentId{fragment});
  }
}

}  // namespace scantrove
