#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/fusion/brick_contents.h"
#include "core/fusion/kernels/brick_page.h"

namespace scantrove {

/// A page of bricks with all that they hold, off the device. Brought back, it is what it was to the last bit.
struct StoredPage {
  /// By local index: an empty place as kernels see it (PAGE_EMPTY_CUBE), 0 where a brick is awake.
  std::array<std::int8_t, PAGE_BRICKS> cells{};
  std::bitset<PAGE_BRICKS> bricks;    ///< which there are, dormant ones too
  std::bitset<PAGE_BRICKS> inactive;  ///< those of them that are laid aside
  BrickContents contents;             ///< in the order of the local indices

  [[nodiscard]] std::vector<std::uint32_t> toWords() const;
  /// Of words that toWords made; none: they are not.
  [[nodiscard]] static std::optional<StoredPage> fromWords(std::span<const std::uint32_t> words);
};

}  // namespace scantrove
