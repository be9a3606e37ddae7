#include "core/catalogue/warped_thumbnail.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/reference/thumbnail_matching.h"

namespace scantrove {
namespace {

Thumbnail noiseThumbnail(unsigned seed) {
  std::mt19937 random(seed);
  Thumbnail thumbnail;
  for (std::int8_t& value : thumbnail.fine)
    value = static_cast<std::int8_t>(static_cast<int>(random() % 255) - 127);
  fillCoarse(thumbnail);
  return thumbnail;
}

/// `thumbnail` moved by some pixels and weakened; mirrored if wanted.
Thumbnail moved(const Thumbnail& thumbnail, int dx, int dy, bool mirrored) {
  Thumbnail result;
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < Thumbnail::kSide; ++y) {
      for (int x = 0; x < Thumbnail::kSide; ++x) {
        const int from_x = (mirrored ? Thumbnail::kSide - 1 - x : x) + dx, from_y = y + dy;
        if (from_x < 0 || from_y < 0 || from_x >= Thumbnail::kSide || from_y >= Thumbnail::kSide) continue;
        const auto from =
            static_cast<std::size_t>(c * Thumbnail::kPixels + from_y * Thumbnail::kSide + from_x);
        result.fine[static_cast<std::size_t>(c * Thumbnail::kPixels + y * Thumbnail::kSide + x)] =
            static_cast<std::int8_t>(thumbnail.fine[from] * 3 / 4);
      }
    }
  }
  fillCoarse(result);
  return result;
}

TEST(WarpedThumbnail, GivesTheDistancesOfTheFormula) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Thumbnail query = noiseThumbnail(seed);
    const WarpedThumbnail warped(query);
    for (const Thumbnail& view :
         {noiseThumbnail(seed + 100), moved(query, 1, -2, false), moved(query, -2, 1, true)})
      EXPECT_EQ(warped.distanceTo(view), reference::ThumbnailMatching(query, view).distance()) << seed;
  }
}

TEST(WarpedThumbnail, IsZeroForTheSame_AndTwoForNothing) {
  EXPECT_EQ(WarpedThumbnail(noiseThumbnail(3)).distanceTo(noiseThumbnail(3)), 0);
  EXPECT_EQ(WarpedThumbnail(Thumbnail()).distanceTo(Thumbnail()), 2);
}

}  // namespace
}  // namespace scantrove
