#include "core/fusion/stored_page.h"

#include <algorithm>

#include "core/base/check.h"

namespace scantrove {
namespace {

// A cell in one word.
constexpr std::uint32_t kCellBits = 0xffU;
constexpr std::uint32_t kIsBrick = 0x100U;
constexpr std::uint32_t kIsInactive = 0x200U;
constexpr std::size_t kWordsOfVoxel = 3;  // distance and weight, label, colour

// Weights are stored in 1/256 observations.
constexpr unsigned kWeightShift = 24;

std::uint32_t wordOf(cl_short distance, cl_uchar weight) {
  return static_cast<std::uint16_t>(distance) | std::uint32_t{weight} << kWeightShift;
}

}  // namespace

std::vector<std::uint32_t> StoredPage::toWords() const {
  const std::size_t count = contents.voxels();
  SCANTROVE_CHECK(count == bricks.count() * BRICK_VOXELS && contents.weights.size() == count);
  SCANTROVE_CHECK(contents.labels.size() == count && contents.colors.size() == count);
  std::vector<std::uint32_t> words(PAGE_BRICKS + kWordsOfVoxel * count);
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    words[i] =
        static_cast<std::uint8_t>(cells[i]) | (bricks[i] ? kIsBrick : 0U) | (inactive[i] ? kIsInactive : 0U);
  }
  const auto place = [&](std::size_t i) {
    return words.begin() + static_cast<std::ptrdiff_t>(PAGE_BRICKS + i * count);
  };
  std::ranges::transform(contents.distances, contents.weights, place(0), wordOf);
  std::ranges::copy(contents.labels, place(1));
  std::ranges::copy(contents.colors, place(2));
  return words;
}

std::optional<StoredPage> StoredPage::fromWords(std::span<const std::uint32_t> words) {
  if (words.size() < PAGE_BRICKS) return std::nullopt;
  StoredPage page;
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    page.cells[i] = static_cast<std::int8_t>(words[i] & kCellBits);
    page.bricks[i] = (words[i] & kIsBrick) != 0;
    page.inactive[i] = (words[i] & kIsInactive) != 0;
    const bool is_cell = page.cells[i] <= 0 && page.cells[i] >= PAGE_EMPTY_CUBE(PAGE_SHIFT);
    const bool is_active = page.bricks[i] && !page.inactive[i];
    // A cell of 0 without a brick would be the slot of another page's brick.
    if (!is_cell || (page.cells[i] == 0) != is_active || (page.inactive[i] && !page.bricks[i]))
      return std::nullopt;
  }
  const std::size_t count = page.bricks.count() * BRICK_VOXELS;
  if (words.size() != PAGE_BRICKS + kWordsOfVoxel * count) return std::nullopt;
  page.contents = BrickContents(page.bricks.count());
  const auto part = [&](std::size_t i) { return words.subspan(PAGE_BRICKS + i * count, count); };
  std::ranges::transform(part(0), page.contents.weights.begin(),
                         [](std::uint32_t word) { return static_cast<cl_uchar>(word >> kWeightShift); });
  std::ranges::transform(part(0), page.contents.distances.begin(), [](std::uint32_t word) {
    if (word >> kWeightShift == 0) return cl_short{DISTANCE_UNSEEN};
    const auto distance = static_cast<cl_short>(word);
    return distance == DISTANCE_UNSEEN ? cl_short{DISTANCE_UNSEEN + 1} : distance;
  });
  std::ranges::copy(part(1), page.contents.labels.begin());
  std::ranges::copy(part(2), page.contents.colors.begin());
  return page;
}

}  // namespace scantrove
