#include "core/meshing/page_reader.h"

#include <algorithm>

namespace scantrove {
namespace {
constexpr std::size_t kMaxKeptBricks = 8192;
}  // namespace

const StoredPage& PageReader::page(int index) {
  const auto found = std::ranges::find(stored_, index, &std::pair<int, StoredPage>::first);
  if (found != stored_.end()) {
    stored_.splice(stored_.begin(), stored_, found);
    return stored_.front().second;
  }
  stored_.emplace_front(index, map_.copyOfPage(index).value_or(StoredPage{}));
  kept_bricks_ += stored_.front().second.bricks.count();
  while (kept_bricks_ > kMaxKeptBricks && stored_.size() > 1) {
    kept_bricks_ -= stored_.back().second.bricks.count();
    stored_.pop_back();
  }
  return stored_.front().second;
}

}  // namespace scantrove
