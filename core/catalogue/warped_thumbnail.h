#pragma once
#include <cstdint>
#include <vector>

#include "core/catalogue/thumbnail.h"

namespace scantrove {

/// A thumbnail that is compared with others without a device: the same integers as the kernels of
/// ThumbnailMatcher, so the same distances. About 0.1 ms for a comparison; any thread.
class WarpedThumbnail {
 public:
  explicit WarpedThumbnail(const Thumbnail& query);

  /// Warped SSD with local shifts: 0 = the same, 2 = unrelated.
  [[nodiscard]] float distanceTo(const Thumbnail& view) const;

 private:
  /// A warp at 32 x 32: a variant, and its first pixel that lies on the view's first one.
  struct Place {
    int variant = 0, row = 0, column = 0;
  };
  [[nodiscard]] Place bestCoarse(const Thumbnail& view) const;

  std::vector<std::int8_t> fine_, coarse_;  // of all variants, with rims of zeros, as in thumbnail_layout.h
};

}  // namespace scantrove
