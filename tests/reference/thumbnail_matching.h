#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/catalogue/thumbnail.h"

namespace scantrove::reference {

/// Warped SSD with local shifts between two thumbnails, pixel by pixel from the formula (Torralba et al.
/// 2008):
///   D = 2 sum (q(w(x)) - v(x))^2 / (sum q(w(x))^2 + sum v(x)^2)
/// smallest over mirror, scale 0.9, 1, 1.1 and translation at 16 x 16; then +-1 pixel at 32 x 32 around the
/// best; then each pixel of q may move by +-1. Pixels outside a thumbnail are 0. The warp is sampled
/// bilinearly in fixed point.
class ThumbnailMatching {
 public:
  ThumbnailMatching(const Thumbnail& query, const Thumbnail& view) : view_(view) {
    for (int variant = 0; variant < 6; ++variant) variants_[variant] = warped(query, variant);
  }

  /// Mirror = variant / 3, scale = {230, 256, 282}[variant % 3] / 256 about the centre.
  static Thumbnail warped(const Thumbnail& query, int variant) {
    const int scales[3] = {230, 256, 282};
    const int scale = scales[variant % 3] * (variant >= 3 ? -1 : 1);
    Thumbnail out;
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
          // 512ths of a pixel; the centre lies at 15.5.
          const int u = (2 * x - 31) * scale + 31 * 256;
          const int v = (2 * y - 31) * (scale < 0 ? -scale : scale) + 31 * 256;
          const int u0 = u >> 9, v0 = v >> 9, fu = u & 511, fv = v & 511;
          int sum = 1 << 17;
          sum += pixel(query.fine.data(), 32, c, v0, u0) * (512 - fv) * (512 - fu);
          sum += pixel(query.fine.data(), 32, c, v0, u0 + 1) * (512 - fv) * fu;
          sum += pixel(query.fine.data(), 32, c, v0 + 1, u0) * fv * (512 - fu);
          sum += pixel(query.fine.data(), 32, c, v0 + 1, u0 + 1) * fv * fu;
          out.fine[static_cast<std::size_t>((c * 32 + y) * 32 + x)] = static_cast<std::int8_t>(sum >> 18);
        }
      }
    }
    fillCoarse(out);
    return out;
  }

  struct Warp {
    int variant = 0, dy = 0, dx = 0;
  };

  /// Distance at 16 x 16 of one of the 6 variants moved by (dx, dy) coarse pixels.
  [[nodiscard]] float coarse(const Warp& warp) const {
    return ratio(variants_[warp.variant].coarse.data(), view_.coarse.data(), 16, warp);
  }
  [[nodiscard]] float fine(const Warp& warp) const {
    return ratio(variants_[warp.variant].fine.data(), view_.fine.data(), 32, warp);
  }

  [[nodiscard]] Warp bestCoarse() const {
    Warp best;
    float smallest = std::numeric_limits<float>::max();
    for (int variant = 0; variant < 6; ++variant) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const float distance = coarse({variant, dy, dx});
          if (distance < smallest) smallest = distance, best = {variant, dy, dx};
        }
      }
    }
    return best;
  }

  [[nodiscard]] Warp bestFine(const Warp& start) const {
    Warp best;
    float smallest = std::numeric_limits<float>::max();
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Warp warp{start.variant, 2 * start.dy + dy, 2 * start.dx + dx};
        const float distance = fine(warp);
        if (distance < smallest) smallest = distance, best = warp;
      }
    }
    return best;
  }

  /// Each pixel (all channels together) uses the best of its 3 x 3 neighbours.
  [[nodiscard]] float shifted(const Warp& warp) const {
    const std::int8_t* q = variants_[warp.variant].fine.data();
    const std::int8_t* v = view_.fine.data();
    std::int64_t ssd = 0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        int best = std::numeric_limits<int>::max();
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            int sum = 0;
            for (int c = 0; c < 3; ++c) {
              const int d = pixel(q, 32, c, y + warp.dy + dy, x + warp.dx + dx) - pixel(v, 32, c, y, x);
              sum += d * d;
            }
            best = std::min(best, sum);
          }
        }
        ssd += best;
      }
    }
    return quotient(ssd, energies(q, v, 32, warp));
  }

  [[nodiscard]] float distance() const { return shifted(bestFine(bestCoarse())); }

 private:
  static int pixel(const std::int8_t* image, int side, int c, int y, int x) {
    return x >= 0 && y >= 0 && x < side && y < side ? image[(c * side + y) * side + x] : 0;
  }
  static std::int64_t energies(const std::int8_t* q, const std::int8_t* v, int side, const Warp& warp) {
    std::int64_t sum = 0;
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const int a = pixel(q, side, c, y + warp.dy, x + warp.dx), b = pixel(v, side, c, y, x);
          sum += a * a + b * b;
        }
      }
    }
    return sum;
  }
  static float ratio(const std::int8_t* q, const std::int8_t* v, int side, const Warp& warp) {
    std::int64_t ssd = 0;
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const int d = pixel(q, side, c, y + warp.dy, x + warp.dx) - pixel(v, side, c, y, x);
          ssd += d * d;
        }
      }
    }
    return quotient(ssd, energies(q, v, side, warp));
  }
  static float quotient(std::int64_t ssd, std::int64_t energy) {
    return energy == 0 ? 2.0F : 2.0F * static_cast<float>(ssd) / static_cast<float>(energy);
  }

  Thumbnail variants_[6];
  const Thumbnail& view_;
};

}  // namespace scantrove::reference
