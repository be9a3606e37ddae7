#include "core/fusion/stored_page.h"

#include <cstring>

#include "core/base/check.h"

namespace scantrove {
namespace {

static_assert(sizeof(TsdfVoxel) == sizeof(std::uint32_t));

// Of a place, in one word.
constexpr std::uint32_t kCellBits = 0xffU;
constexpr std::uint32_t kIsBrick = 0x100U;
constexpr std::uint32_t kIsDormant = 0x200U;
constexpr std::size_t kPools = 3;

}  // namespace

std::vector<std::uint32_t> StoredPage::toWords() const {
  SCANTROVE_CHECK(voxels.size() == bricks.count() * BRICK_VOXELS);
  SCANTROVE_CHECK(labels.size() == voxels.size() && colors.size() == voxels.size());
  std::vector<std::uint32_t> words(PAGE_BRICKS + kPools * voxels.size());
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    words[i] =
        static_cast<std::uint8_t>(cells[i]) | (bricks[i] ? kIsBrick : 0U) | (dormant[i] ? kIsDormant : 0U);
  }
  if (voxels.empty()) return words;
  std::uint32_t* to = words.data() + PAGE_BRICKS;
  std::memcpy(to, voxels.data(), voxels.size() * sizeof(TsdfVoxel));
  std::memcpy(to + voxels.size(), labels.data(), labels.size() * sizeof(cl_uint));
  std::memcpy(to + 2 * voxels.size(), colors.data(), colors.size() * sizeof(cl_uint));
  return words;
}

std::optional<StoredPage> StoredPage::fromWords(std::span<const std::uint32_t> words) {
  if (words.size() < PAGE_BRICKS) return std::nullopt;
  StoredPage page;
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    page.cells[i] = static_cast<std::int8_t>(words[i] & kCellBits);
    page.bricks[i] = (words[i] & kIsBrick) != 0;
    page.dormant[i] = (words[i] & kIsDormant) != 0;
    const bool is_cell = page.cells[i] <= 0 && page.cells[i] >= PAGE_EMPTY_CUBE(PAGE_SHIFT);
    if (!is_cell || (page.dormant[i] && !page.bricks[i])) return std::nullopt;
  }
  const std::size_t count = page.bricks.count() * BRICK_VOXELS;
  if (words.size() != PAGE_BRICKS + kPools * count) return std::nullopt;
  page.voxels.resize(count);
  page.labels.resize(count);
  page.colors.resize(count);
  if (count == 0) return page;
  const std::uint32_t* from = words.data() + PAGE_BRICKS;
  std::memcpy(page.voxels.data(), from, count * sizeof(TsdfVoxel));
  std::memcpy(page.labels.data(), from + count, count * sizeof(cl_uint));
  std::memcpy(page.colors.data(), from + 2 * count, count * sizeof(cl_uint));
  return page;
}

}  // namespace scantrove
