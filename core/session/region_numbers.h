#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The 16-bit numbers of regions in label images: their ids where possible. Ids grow during a scan: a
/// region beyond 16 bits takes over the number that was unused for the longest time.
class RegionNumbers {
 public:
  /// The number of a region, at most 65535; none stays 0.
  std::uint32_t numberOf(RegionId region);
  /// The same for a whole image.
  [[nodiscard]] std::vector<std::uint32_t> numbersOf(std::span<const RegionId> regions);
  /// The region with an assigned number.
  [[nodiscard]] RegionId regionOf(std::uint32_t number) const {
    return number < entries_.size() ? entries_[number].region : RegionId{};
  }
  /// The current number of a region; none: never written, or its number was reassigned.
  [[nodiscard]] std::optional<std::uint32_t> knownNumberOf(RegionId region) const;
  [[nodiscard]] std::size_t count() const {
    return number_of_region_.size();
  }  ///< numbers in use, including 0

 private:
  [[nodiscard]] std::size_t freeNumberFor(RegionId region);
  struct Entry {
    RegionId region;
    std::uint64_t last_use = 0;
  };
  std::unordered_map<RegionId, std::uint32_t> number_of_region_{{RegionId{}, 0}};
  std::vector<Entry> entries_{Entry{}};  // by number
  std::uint64_t uses_ = 0;
};

}  // namespace scantrove
