#include "core/scan/region_numbers.h"

#include <algorithm>
#include <limits>

namespace scantrove {

std::uint32_t RegionNumbers::numberOf(RegionId region) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  if (!region) return 0;
  auto known = number_of_region_.find(region);
  if (known == number_of_region_.end()) {
    std::size_t number = entries_.size();
    if (number <= kMost) {
      entries_.emplace_back();
    } else {
      const auto oldest =
          std::ranges::min_element(entries_.begin() + 1, entries_.end(), {}, &Entry::last_use);
      number = static_cast<std::size_t>(oldest - entries_.begin());
      number_of_region_.erase(oldest->region);
    }
    entries_[number].region = region;
    known = number_of_region_.emplace(region, static_cast<std::uint32_t>(number)).first;
  }
  entries_[known->second].last_use = ++uses_;
  return known->second;
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
