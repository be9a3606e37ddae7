#pragma once
#include <algorithm>
#include <compare>
#include <initializer_list>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Regions that together may be one object (thesis ch. 6). In rising order, each once.
class RegionSet {
 public:
  RegionSet() = default;
  RegionSet(std::initializer_list<RegionId> regions) {
    for (const RegionId region : regions) add(region);
  }

  [[nodiscard]] auto begin() const { return regions_.begin(); }
  [[nodiscard]] auto end() const { return regions_.end(); }

  void add(RegionId region) {
    const auto place = std::ranges::lower_bound(regions_, region);
    if (place == regions_.end() || *place != region) regions_.insert(place, region);
  }
  void add(const RegionSet& other) {
    for (const RegionId region : other) add(region);
  }
  /// `from` is now part of `into`.
  void join(RegionId into, RegionId from) {
    if (std::erase(regions_, from) > 0) add(into);
  }

  [[nodiscard]] bool contains(RegionId region) const {
    return std::ranges::find(regions_, region) != regions_.end();  // few
  }
  [[nodiscard]] bool overlaps(const RegionSet& other) const {
    return std::ranges::any_of(regions_, [&](RegionId region) { return other.contains(region); });
  }
  [[nodiscard]] std::size_t size() const { return regions_.size(); }
  [[nodiscard]] bool empty() const { return regions_.empty(); }

  auto operator<=>(const RegionSet&) const = default;

 private:
  std::vector<RegionId> regions_;
};

}  // namespace scantrove
