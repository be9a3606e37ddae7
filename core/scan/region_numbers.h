#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Small numbers for the regions that results mention: region ids grow as long as the scan goes on, files
/// hold 16 bits. A region gets the next number when it is first written, and keeps it; once all are given,
/// the one that was not written for the longest time goes to the new region.
class RegionNumbers {
 public:
  /// Number of a region, at most 65535; none stays 0.
  std::uint32_t numberOf(RegionId region);
  /// The same for a whole image.
  [[nodiscard]] std::vector<std::uint32_t> numbersOf(std::span<const RegionId> regions);
  /// The region that has a number which was given out.
  [[nodiscard]] RegionId regionOf(std::uint32_t number) const { return entries_[number].region; }
  [[nodiscard]] std::size_t count() const { return entries_.size(); }  ///< numbers given out, 0 included

 private:
  struct Entry {
    RegionId region;
    std::uint64_t last_use = 0;
  };
  std::unordered_map<RegionId, std::uint32_t> number_of_region_{{RegionId{}, 0}};
  std::vector<Entry> entries_{Entry{}};
  std::uint64_t uses_ = 0;
};

}  // namespace scantrove
