#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Small numbers for the regions that results mention: region ids grow with every frame, files hold 16 bits.
/// A region gets the next number when it is first written, and keeps it.
class RegionNumbers {
 public:
  /// Number of a region id; 0 stays 0.
  std::uint32_t numberOf(RegionId region);
  /// The same for a whole image.
  [[nodiscard]] std::vector<std::uint32_t> numbersOf(std::span<const RegionId> regions);
  /// Region id of a number that was given out.
  [[nodiscard]] RegionId regionOf(std::uint32_t number) const { return regions_[number]; }
  [[nodiscard]] std::size_t count() const { return regions_.size(); }  ///< numbers given out, 0 included

 private:
  std::unordered_map<RegionId, std::uint32_t> number_of_region_{{RegionId{}, 0}};
  std::vector<RegionId> regions_{RegionId{}};
};

}  // namespace scantrove
