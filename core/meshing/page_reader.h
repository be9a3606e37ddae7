#pragma once
#include <list>
#include <utility>

#include "core/fusion/brick_map.h"

namespace scantrove {

/// Pages of a map on the host. The last ones that were asked for are kept: about 50 MB. The map stays as it
/// is meanwhile. The thread of the map's context.
class PageReader {
 public:
  explicit PageReader(BrickMap& map) : map_(map) {}

  /// What a page holds, valid until the next call; without bricks where it cannot be read
  /// (BrickMap::takeFailure).
  [[nodiscard]] const StoredPage& page(int index);

  [[nodiscard]] const BrickMap& map() const { return map_; }

 private:
  BrickMap& map_;
  std::list<std::pair<int, StoredPage>> stored_;  ///< last asked for first
  std::size_t kept_bricks_ = 0;
};

}  // namespace scantrove
