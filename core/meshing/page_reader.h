#pragma once
#include <list>
#include <utility>

#include "core/fusion/brick_map.h"

namespace scantrove {

/// Pages of a map on the host, with a cache of the last ones (about 50 MB). The map must not change
/// meanwhile. The thread of the map's context.
class PageReader {
 public:
  explicit PageReader(BrickMap& map) : map_(map) {}

  /// A page, valid until the next call; without bricks if it cannot be read (BrickMap::takeFailure).
  [[nodiscard]] const StoredPage& page(int index);

  [[nodiscard]] const BrickMap& map() const { return map_; }

 private:
  BrickMap& map_;
  std::list<std::pair<int, StoredPage>> stored_;  ///< most recently used first
  std::size_t kept_bricks_ = 0;
};

}  // namespace scantrove
