#include "core/scan/region_numbers.h"

namespace scantrove {

std::uint32_t RegionNumbers::numberOf(RegionId region) {
  const auto [entry, is_new] =
      number_of_region_.try_emplace(region, static_cast<std::uint32_t>(regions_.size()));
  if (is_new) regions_.push_back(region);
  return entry->second;
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
