#include "core/catalogue/warped_thumbnail.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "core/catalogue/kernels/thumbnail_layout.h"

namespace scantrove {
namespace {

constexpr std::array<int, 3> kWarpScales{230, 256, 282};  // of 256, as in warp_queries.cl

std::size_t indexAt(int index) { return static_cast<std::size_t>(index); }

float quotientOf(int ssd, int energy) {
  return energy == 0 ? 2.0F : 2.0F * static_cast<float>(ssd) / static_cast<float>(energy);
}

int pixelOrZero(const std::int8_t* plane, int y, int x) {
  return x >= 0 && y >= 0 && x < FINE_SIDE && y < FINE_SIDE ? plane[y * FINE_SIDE + x] : 0;
}

/// A pixel of a mirrored and scaled copy: bilinear, in 512ths of a pixel.
std::int8_t warpedPixel(const std::int8_t* plane, int variant, int y, int x) {
  const int scale = kWarpScales[indexAt(variant % 3)];
  const int u = (2 * x - 31) * (variant >= 3 ? -scale : scale) + 31 * 256,
            v = (2 * y - 31) * scale + 31 * 256;
  const int u0 = u >> 9, v0 = v >> 9, fu = u & 511, fv = v & 511;
  const int sum = (1 << 17) + pixelOrZero(plane, v0, u0) * (512 - fv) * (512 - fu) +
                  pixelOrZero(plane, v0, u0 + 1) * (512 - fv) * fu +
                  pixelOrZero(plane, v0 + 1, u0) * fv * (512 - fu) +
                  pixelOrZero(plane, v0 + 1, u0 + 1) * fv * fu;
  return static_cast<std::int8_t>(sum >> 18);
}

/// Three planes with a rim, from (row, column) on, beside those of a view.
struct Overlaid {
  const std::int8_t* query;
  const std::int8_t* view;
  int stride, side;

  [[nodiscard]] int queryAt(int c, int y, int x) const { return query[(c * stride + y) * stride + x]; }
  [[nodiscard]] int viewAt(int c, int y, int x) const { return view[(c * side + y) * side + x]; }
};

struct Sums {
  int ssd = 0, energy = 0;
};

Sums sumsOf(const Overlaid& planes) {
  Sums sums;
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < planes.side; ++y) {
      for (int x = 0; x < planes.side; ++x) {
        const int a = planes.queryAt(c, y, x), b = planes.viewAt(c, y, x);
        sums.ssd += (a - b) * (a - b);
        sums.energy += a * a + b * b;
      }
    }
  }
  return sums;
}

/// Each pixel of the view with the best of its 3 x 3 neighbours in the query.
int shiftedSsd(const Overlaid& planes) {
  int ssd = 0;
  for (int y = 0; y < planes.side; ++y) {
    for (int x = 0; x < planes.side; ++x) {
      int best = std::numeric_limits<int>::max();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          int sum = 0;
          for (int c = 0; c < 3; ++c) {
            const int d = planes.queryAt(c, y + dy, x + dx) - planes.viewAt(c, y, x);
            sum += d * d;
          }
          best = std::min(best, sum);
        }
      }
      ssd += best;
    }
  }
  return ssd;
}

}  // namespace

WarpedThumbnail::WarpedThumbnail(const Thumbnail& query)
    : fine_(indexAt(THUMBNAIL_VARIANTS * FINE_QUERY_BYTES)),
      coarse_(indexAt(THUMBNAIL_VARIANTS * COARSE_QUERY_BYTES)) {
  for (int variant = 0; variant < THUMBNAIL_VARIANTS; ++variant) {
    Thumbnail copy;
    for (int c = 0; c < 3; ++c) {
      const std::int8_t* const plane = &query.fine[indexAt(c * FINE_SIDE * FINE_SIDE)];
      for (int y = 0; y < FINE_SIDE; ++y) {
        for (int x = 0; x < FINE_SIDE; ++x)
          copy.fine[indexAt((c * FINE_SIDE + y) * FINE_SIDE + x)] = warpedPixel(plane, variant, y, x);
      }
    }
    fillCoarse(copy);
    const auto put = [variant](const auto& planes, int side, int rim, std::vector<std::int8_t>& with_rim) {
      const int stride = side + 2 * rim;
      for (int row = 0; row < 3 * side; ++row) {
        const int to = ((variant * 3 + row / side) * stride + row % side + rim) * stride + rim;
        std::copy_n(planes.data() + row * side, side, &with_rim[indexAt(to)]);
      }
    };
    put(copy.fine, FINE_SIDE, FINE_RIM, fine_);
    put(copy.coarse, COARSE_SIDE, COARSE_RIM, coarse_);
  }
}

WarpedThumbnail::Place WarpedThumbnail::bestCoarse(const Thumbnail& view) const {
  Place best;
  float smallest = std::numeric_limits<float>::max();
  for (int warp = 0; warp < THUMBNAIL_WARPS; ++warp) {
    const int variant = warp / THUMBNAIL_SHIFTS, shift = warp % THUMBNAIL_SHIFTS;
    const int from = variant * COARSE_QUERY_BYTES + shift / 3 * COARSE_STRIDE + shift % 3;
    const Sums sums = sumsOf({&coarse_[indexAt(from)], view.coarse.data(), COARSE_STRIDE, COARSE_SIDE});
    const float distance = quotientOf(sums.ssd, sums.energy);
    if (distance >= smallest) continue;
    smallest = distance;
    best = {variant, FINE_RIM + 2 * (shift / 3 - 1), FINE_RIM + 2 * (shift % 3 - 1)};
  }
  return best;
}

float WarpedThumbnail::distanceTo(const Thumbnail& view) const {
  const Place place = bestCoarse(view);
  const auto planesAt = [&](int dy, int dx) {
    const int from = place.variant * FINE_QUERY_BYTES + (place.row + dy) * FINE_STRIDE + place.column + dx;
    return Overlaid{&fine_[indexAt(from)], view.fine.data(), FINE_STRIDE, FINE_SIDE};
  };
  Overlaid best = planesAt(0, 0);
  int energy = 0;
  float smallest = std::numeric_limits<float>::max();
  for (int shift = 0; shift < THUMBNAIL_SHIFTS; ++shift) {
    const Overlaid planes = planesAt(shift / 3 - 1, shift % 3 - 1);
    const Sums sums = sumsOf(planes);
    const float distance = quotientOf(sums.ssd, sums.energy);
    if (distance >= smallest) continue;
    smallest = distance;
    best = planes;
    energy = sums.energy;
  }
  return quotientOf(shiftedSsd(best), energy);
}

}  // namespace scantrove
