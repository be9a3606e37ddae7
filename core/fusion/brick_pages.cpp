#include "core/fusion/brick_pages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr double kLargestPage =
    1 << 27;  // the last page of the space of 32-bit brick coordinates, and a little less

Eigen::Vector3i pageOf(const Eigen::Vector3i& brick) {
  return {brick.x() >> PAGE_SHIFT, brick.y() >> PAGE_SHIFT, brick.z() >> PAGE_SHIFT};
}

std::size_t localIndex(const Eigen::Vector3i& local) {
  const Eigen::Matrix<std::size_t, 3, 1> i = local.cast<std::size_t>();
  return i.x() + PAGE_SIDE * (i.y() + PAGE_SIDE * i.z());
}

Eigen::Vector3i clampedPage(const Eigen::Vector3d& position) {
  return position.array().floor().max(-kLargestPage).min(kLargestPage).cast<int>();
}

}  // namespace

std::size_t localBrick(const Eigen::Vector3i& brick) { return localIndex(brick - PAGE_SIDE * pageOf(brick)); }

Eigen::Vector3i brickOfPage(const BrickPages::Page& page, std::size_t local) {
  const int i = static_cast<int>(local);
  return PAGE_SIDE * page.position +
         Eigen::Vector3i(i % PAGE_SIDE, i / PAGE_SIDE % PAGE_SIDE, i / (PAGE_SIDE * PAGE_SIDE));
}

BrickPages::BrickPages() : pages_(1), page_slots_(PAGE_BRICKS, PAGE_EMPTY_CUBE(PAGE_SHIFT)) {}

int BrickPages::takeBlock() {
  if (!free_blocks_.empty()) {
    const int block = free_blocks_.back();
    free_blocks_.pop_back();
    return block;
  }
  const std::size_t old_size = page_slots_.size();
  page_slots_.resize(old_size + PAGE_BRICKS);
  return static_cast<int>(old_size / PAGE_BRICKS);
}

int BrickPages::pageWith(const Eigen::Vector3i& brick) const { return index_.slotOf(pageOf(brick)); }

int BrickPages::add(const Eigen::Vector3i& position) {
  int index = index_.slotOf(position);
  if (index == BRICK_NONE) {
    index = static_cast<int>(pages_.size());
    index_.insert(position, index);
    pages_.emplace_back().position = position;
  }
  return index;
}

void BrickPages::insert(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed) {
  const Eigen::Vector3i position = pageOf(brick);
  const int index = add(position);
  Page& page = pages_[static_cast<std::size_t>(index)];
  SCANTROVE_CHECK(!page.record);
  if (page.block == PAGE_EMPTY) {
    Cells empty;
    empty.fill(PAGE_EMPTY_CUBE(PAGE_SHIFT - 1));
    putBack(index, empty, {}, changed);
  }
  const Eigen::Vector3i local = brick - PAGE_SIDE * position;
  const std::size_t block_start = static_cast<std::size_t>(page.block) * PAGE_BRICKS;
  for (int level = PAGE_SHIFT - 1; level > 0; --level) keepEmptyBelow(level, block_start, local, changed);
  const std::size_t element = block_start + localIndex(local);
  page_slots_[element] = slot;
  changed.push_back(element);
  page.slots.insert(std::upper_bound(page.slots.begin(), page.slots.end(), slot), slot);
  std::erase(page.inactive, slot);
}

void BrickPages::deactivate(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed) {
  const int index = pageWith(brick);
  SCANTROVE_CHECK(index != BRICK_NONE);
  Page& page = pages_[static_cast<std::size_t>(index)];
  std::erase(page.slots, slot);
  page.inactive.push_back(slot);
  // A larger empty cube may exist around the brick, but a smaller one is never wrong.
  const std::size_t element = static_cast<std::size_t>(page.block) * PAGE_BRICKS + localBrick(brick);
  page_slots_[element] = PAGE_EMPTY_CUBE(0);
  changed.push_back(element);
}

BrickPages::Cells BrickPages::takeOut(int index) {
  Page& page = pages_[static_cast<std::size_t>(index)];
  SCANTROVE_CHECK(page.block != PAGE_EMPTY);
  Cells cells;
  std::copy_n(page_slots_.begin() + static_cast<std::ptrdiff_t>(page.block) * PAGE_BRICKS, PAGE_BRICKS,
              cells.begin());
  free_blocks_.push_back(page.block);
  page.block = PAGE_EMPTY;
  page.slots.clear();
  page.inactive.clear();
  return cells;
}

void BrickPages::putBack(int index, const Cells& cells, std::vector<int> inactive,
                         std::vector<std::size_t>& changed) {
  Page& page = pages_[static_cast<std::size_t>(index)];
  SCANTROVE_CHECK(page.block == PAGE_EMPTY);
  const std::size_t old_size = page_slots_.size();
  page.block = takeBlock();
  const std::size_t block_start = static_cast<std::size_t>(page.block) * PAGE_BRICKS;
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    page_slots_[block_start + i] = cells[i];
    if (block_start < old_size) changed.push_back(block_start + i);
    if (cells[i] >= 0) page.slots.push_back(cells[i]);
  }
  std::ranges::sort(page.slots);
  page.inactive = std::move(inactive);
}

// The cube of (2^level)^3 bricks around `local` is no longer empty: its empty bricks may claim smaller cubes
// only.
void BrickPages::keepEmptyBelow(int level, std::size_t block_start, const Eigen::Vector3i& local,
                                std::vector<std::size_t>& changed) {
  const int side = 1 << level;
  const Eigen::Vector3i first(local.x() & -side, local.y() & -side, local.z() & -side);
  if (page_slots_[block_start + localIndex(local)] > PAGE_EMPTY_CUBE(level)) return;
  for (int i = 0; i < side * side * side; ++i) {
    const Eigen::Vector3i offset(i % side, i / side % side, i / (side * side));
    const std::size_t element = block_start + localIndex(first + offset);
    page_slots_[element] = PAGE_EMPTY_CUBE(level - 1);
    changed.push_back(element);
  }
}

std::vector<int> BrickPages::pagesInView(const ViewFrustum& frustum, double brick_size_m) const {
  const double page_size_m = PAGE_SIDE * brick_size_m;
  const double brick_radius_m = 0.5 * std::sqrt(3.0) * brick_size_m;
  // Every brick's sphere lies in its page's sphere, enlarged by the margin of a sphere around its brick.
  const double page_radius_m = 0.5 * std::sqrt(3.0) * page_size_m + brick_radius_m;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(brick_radius_m);
  const Eigen::Vector3i first = clampedPage((frustum.boundsWorld().min() - margin) / page_size_m);
  const Eigen::Vector3i last = clampedPage((frustum.boundsWorld().max() + margin) / page_size_m);

  std::vector<int> result;
  const auto addIfSeen = [&](int index, const Eigen::Vector3i& position) {
    const Eigen::Vector3d center = (position.cast<double>().array() + 0.5) * page_size_m;
    if (frustum.intersectsSphere(center, page_radius_m)) result.push_back(index);
  };
  const double box = ((last - first).cast<double>().array() + 1.0).prod();
  if (box > static_cast<double>(pages_.size())) {
    // The view is larger than the map, so visit the existing pages.
    for (std::size_t i = 1; i < pages_.size(); ++i) addIfSeen(static_cast<int>(i), pages_[i].position);
    return result;
  }
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        const int index = index_.slotOf({x, y, z});
        if (index != BRICK_NONE) addIfSeen(index, {x, y, z});
      }
    }
  }
  return result;
}

}  // namespace scantrove
