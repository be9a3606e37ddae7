#include "core/session/region_numbers.h"

#include <algorithm>
#include <limits>

namespace scantrove {

std::uint32_t RegionNumbers::numberOf(RegionId region) {
  if (!region) return 0;
  auto known = number_of_region_.find(region);
  if (known == number_of_region_.end()) {
    const std::size_t number = freeNumberFor(region);
    if (entries_[number].region) number_of_region_.erase(entries_[number].region);
    entries_[number].region = region;
    known = number_of_region_.emplace(region, static_cast<std::uint32_t>(number)).first;
  }
  entries_[known->second].last_use = ++uses_;
  return known->second;
}

std::size_t RegionNumbers::freeNumberFor(RegionId region) {
  constexpr std::size_t kMax = std::numeric_limits<std::uint16_t>::max();
  const std::size_t own = region.value;
  if (own <= kMax) {
    if (entries_.size() <= own) entries_.resize(own + 1);
    if (!entries_[own].region) return own;
  }
  entries_.resize(kMax + 1);
  const auto oldest = std::ranges::min_element(entries_.begin() + 1, entries_.end(), {}, &Entry::last_use);
  return static_cast<std::size_t>(oldest - entries_.begin());
}

std::optional<std::uint32_t> RegionNumbers::knownNumberOf(RegionId region) const {
  const auto known = number_of_region_.find(region);
  return known == number_of_region_.end() ? std::nullopt : std::optional(known->second);
}

std::vector<std::uint32_t> RegionNumbers::numbersOf(std::span<const RegionId> regions) {
  std::vector<std::uint32_t> numbers(regions.size());
  RegionId last_region;
  std::uint32_t last_number = 0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (regions[i] != last_region) {
      last_region = regions[i];
      last_number = numberOf(last_region);
    }
    numbers[i] = last_number;
  }
  return numbers;
}

}  // namespace scantrove
