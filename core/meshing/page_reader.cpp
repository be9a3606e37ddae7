#include "core/meshing/page_reader.h"

#include <algorithm>

namespace scantrove {
namespace {
constexpr std::size_t kMostKeptBricks = 8192;
}  // namespace

const StoredPage& PageReader::page(int index) {
  const auto found = std::ranges::find(kept_, index, &std::pair<int, StoredPage>::first);
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().second;
  }
  kept_.emplace_front(index, map_.copyOfPage(index).value_or(StoredPage{}));
  kept_bricks_ += kept_.front().second.bricks.count();
  while (kept_bricks_ > kMostKeptBricks && kept_.size() > 1) {
    kept_bricks_ -= kept_.back().second.bricks.count();
    kept_.pop_back();
  }
  return kept_.front().second;
}

}  // namespace scantrove
