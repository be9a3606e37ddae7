#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace scantrove {

/// Small numbers for the regions that results mention: raw labels grow with every frame, files hold 16 bits.
/// A region gets the next number when it is first written, and keeps it.
class RegionNumbers {
 public:
  /// Number of a region id; 0 stays 0.
  std::uint32_t numberOf(std::uint32_t region);
  /// The same for a whole image.
  [[nodiscard]] std::vector<std::uint32_t> numbersOf(std::span<const std::uint32_t> regions);
  /// Region id of a number that was given out.
  [[nodiscard]] std::uint32_t regionOf(std::uint32_t number) const { return regions_[number]; }
  [[nodiscard]] std::size_t count() const { return regions_.size(); }  ///< numbers given out, 0 included

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> number_of_region_{{0, 0}};
  std::vector<std::uint32_t> regions_{0};
};

}  // namespace scantrove
