#include "core/image/png_filters.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace scantrove {

namespace {

constexpr int kPaethFilter = 4;

/// High and low bytes of one pixel in each of four rows: h0 l0 h1 l1 h2 l2 h3 l3.
constexpr std::size_t kRowsAtOnce = 4;
using Lanes = std::int16_t __attribute__((vector_size(16)));

Lanes absolute(Lanes value) { return value < 0 ? -value : value; }

/// Paeth's choice of the neighbour that predicts best. Without branches: in noisy depth it is as good as
/// random.
Lanes paeth(Lanes left, Lanes up, Lanes up_left) {
  const Lanes to_left = up - up_left;
  const Lanes to_up = left - up_left;
  const Lanes from_left = absolute(to_left);
  const Lanes from_up = absolute(to_up);
  const Lanes from_up_left = absolute(to_left + to_up);
  const Lanes other = from_up <= from_up_left ? up : up_left;
  return ((from_left <= from_up) & (from_left <= from_up_left)) ? left : other;
}

/// Undoes Paeth's filter in four rows below each other in place. A pixel needs its left neighbour, which
/// makes a row one long chain of dependences; so the rows run side by side, each one pixel behind the row
/// above, whose last result then is the pixel above.
class PaethRows {
 public:
  /// Rows of `width` pixels start `stride` bytes apart; `above` is the row above the first.
  PaethRows(std::uint8_t* rows, std::size_t stride, const std::uint8_t* above, std::size_t width)
      : rows_(rows), stride_(stride), above_(above), width_(width) {}

  void unfilter() {
    constexpr std::size_t kLag = kRowsAtOnce - 1;
    std::size_t at = 0;
    for (; at < std::min(kLag, width_); ++at) {
      step<false>(at);
    }
    for (; at < width_; ++at) {
      step<true>(at);
    }
    for (; at < width_ + kLag; ++at) {
      step<false>(at);
    }
  }

 private:
  /// Pixel `at` of the first row, at - 1 of the second ... A row that has not begun computes zeros, one that
  /// is over what nobody uses. `kInside`: all four are inside.
  template <bool kInside>
  void step(std::size_t at) {
    const auto isInside = [&](std::size_t row) { return kInside || (at >= row && at - row < width_); };
    Lanes up = __builtin_shufflevector(left_, left_, 0, 0, 0, 1, 2, 3, 4, 5);
    if (isInside(0)) {
      up[0] = above_[kPngPixelSize * at];
      up[1] = above_[kPngPixelSize * at + 1];
    }
    Lanes filtered = {};
#pragma GCC unroll 4
    for (std::size_t row = 0; row < kRowsAtOnce; ++row) {
      if (isInside(row)) {
        filtered[2 * row] = pixel(row, at)[0];
        filtered[2 * row + 1] = pixel(row, at)[1];
      }
    }
    left_ = (filtered + paeth(left_, up, up_left_)) & 0xFF;
    up_left_ = up;
#pragma GCC unroll 4
    for (std::size_t row = 0; row < kRowsAtOnce; ++row) {
      if (isInside(row)) {
        pixel(row, at)[0] = static_cast<std::uint8_t>(left_[2 * row]);
        pixel(row, at)[1] = static_cast<std::uint8_t>(left_[2 * row + 1]);
      }
    }
  }

  [[nodiscard]] std::uint8_t* pixel(std::size_t row, std::size_t at) const {
    return rows_ + row * stride_ + kPngPixelSize * (at - row);
  }

  std::uint8_t* rows_;
  std::size_t stride_;
  const std::uint8_t* above_;
  std::size_t width_;
  Lanes left_ = {}, up_left_ = {};
};

std::uint8_t paeth(int left, int up, int up_left) {
  const int from_left = std::abs(up - up_left);
  const int from_up = std::abs(left - up_left);
  const int from_up_left = std::abs(left + up - 2 * up_left);
  const int other = from_up <= from_up_left ? up : up_left;
  return static_cast<std::uint8_t>(from_left <= from_up && from_left <= from_up_left ? left : other);
}

/// Whether four rows from here, `stride` bytes apart and each with its filter first, all use Paeth's.
bool arePaeth(const std::uint8_t* rows, std::size_t stride) {
  return rows[0] == kPaethFilter && rows[stride] == kPaethFilter && rows[2 * stride] == kPaethFilter &&
         rows[3 * stride] == kPaethFilter;
}

/// Undoes one row's filter in place (PNG specification, 9.2). `up` is the row above, zeros for the first. The
/// first pixel has zeros on its left.
bool unfilter(int filter, std::uint8_t* row, const std::uint8_t* up, std::size_t size) {
  const auto add = [row](std::size_t i, int value) { row[i] = static_cast<std::uint8_t>(row[i] + value); };
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (std::size_t i = kPngPixelSize; i < size; ++i) {
        add(i, row[i - kPngPixelSize]);
      }
      return true;
    case 2:
      for (std::size_t i = 0; i < size; ++i) {
        add(i, up[i]);
      }
      return true;
    case 3:
      for (std::size_t i = 0; i < size; ++i) {
        add(i, ((i < kPngPixelSize ? 0 : row[i - kPngPixelSize]) + up[i]) / 2);
      }
      return true;
    case kPaethFilter:
      for (std::size_t i = 0; i < size; ++i) {
        const bool is_first = i < kPngPixelSize;
        add(i, paeth(is_first ? 0 : row[i - kPngPixelSize], up[i], is_first ? 0 : up[i - kPngPixelSize]));
      }
      return true;
    default:
      return false;
  }
}

}  // namespace

bool undoPngFilters(std::uint8_t* rows, std::size_t width, std::size_t height) {
  const std::size_t stride = 1 + width * kPngPixelSize;
  const std::vector<std::uint8_t> zeros(stride);
  const std::uint8_t* above = zeros.data();
  for (std::size_t y = 0; y < height;) {
    std::uint8_t* const row = rows + y * stride + 1;
    std::size_t done = 1;
    if (y + kRowsAtOnce <= height && arePaeth(row - 1, stride)) {
      PaethRows(row, stride, above, width).unfilter();
      done = kRowsAtOnce;
    } else if (!unfilter(row[-1], row, above, stride - 1)) {
      return false;
    }
    y += done;
    above = row + (done - 1) * stride;
  }
  return true;
}

}  // namespace scantrove
