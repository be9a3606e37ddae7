#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The numbers by which label images, of 16 bits, mention regions: their ids, as everywhere else. Ids grow as
/// long as the scan goes on: a region beyond the 16 bits gets the number that was not written for the longest
/// time, and keeps it likewise.
class RegionNumbers {
 public:
  /// Number of a region, at most 65535; none stays 0.
  std::uint32_t numberOf(RegionId region);
  /// The same for a whole image.
  [[nodiscard]] std::vector<std::uint32_t> numbersOf(std::span<const RegionId> regions);
  /// The region that has a number which was given out.
  [[nodiscard]] RegionId regionOf(std::uint32_t number) const {
    return number < entries_.size() ? entries_[number].region : RegionId{};
  }
  /// The number that a region has; none: it was not written, or had to give it away.
  [[nodiscard]] std::optional<std::uint32_t> knownNumberOf(RegionId region) const;
  [[nodiscard]] std::size_t count() const {
    return number_of_region_.size();
  }  ///< numbers in use, 0 included

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
