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

/// A page of bricks with their contents, off the device. Restoring it reproduces the page to the last bit.
struct StoredPage {
  /// By local index: the empty cell for kernels (PAGE_EMPTY_CUBE), or 0 for an active brick.
  std::array<std::int8_t, PAGE_BRICKS> cells{};
  std::bitset<PAGE_BRICKS> bricks;    ///< existing bricks, including inactive ones
  std::bitset<PAGE_BRICKS> inactive;  ///< the inactive ones of them
  BrickContents contents;             ///< in the order of the local indices

  [[nodiscard]] std::vector<std::uint32_t> toWords() const;
  /// From the words of toWords(); none if they are invalid.
  [[nodiscard]] static std::optional<StoredPage> fromWords(std::span<const std::uint32_t> words);
};

}  // namespace scantrove
