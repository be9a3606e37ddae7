#include "core/texturing/rect_packer.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace scantrove {
namespace {

/// The first free row of each column, as steps from left to right.
class Skyline {
 public:
  explicit Skyline(const cv::Size& bin) : bin_(bin), steps_{{0, 0, bin.width}} {}

  /// Places a rectangle; none: there is no room.
  std::optional<cv::Point> place(const cv::Size& size) {
    std::optional<cv::Point> best;
    std::size_t best_step = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const std::optional<int> row = rowAt(i, size.width);
      if (!row || *row + size.height > bin_.height) continue;
      if (best && *row >= best->y) continue;
      best = cv::Point(steps_[i].column, *row);
      best_step = i;
    }
    if (best) cover(best_step, {best->x, best->y + size.height, size.width});
    return best;
  }

 private:
  struct Step {
    int column, row, width;
  };

  /// The first row that is free above `width` columns from the step on; none: they reach out of the bin.
  [[nodiscard]] std::optional<int> rowAt(std::size_t step, int width) const {
    if (steps_[step].column + width > bin_.width) return std::nullopt;
    int row = 0;
    for (int covered = 0; covered < width; covered += steps_[step++].width)
      row = std::max(row, steps_[step].row);
    return row;
  }

  void cover(std::size_t at, const Step& top) {
    const int end = top.column + top.width;
    std::size_t last = at;
    while (last < steps_.size() && steps_[last].column + steps_[last].width <= end) ++last;
    if (last < steps_.size() && steps_[last].column < end) {
      steps_[last].width -= end - steps_[last].column;
      steps_[last].column = end;
    }
    const auto first = steps_.begin() + static_cast<std::ptrdiff_t>(at);
    steps_.insert(steps_.erase(first, steps_.begin() + static_cast<std::ptrdiff_t>(last)), top);
  }

  cv::Size bin_;
  std::vector<Step> steps_;
};

}  // namespace

std::optional<std::vector<cv::Point>> packRects(std::span<const cv::Size> sizes, const cv::Size& bin) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::tuple(-sizes[a].height, -sizes[a].width, a) <
           std::tuple(-sizes[b].height, -sizes[b].width, b);
  });
  Skyline skyline(bin);
  std::vector<cv::Point> places(sizes.size());
  for (const std::size_t i : order) {
    const std::optional<cv::Point> place = skyline.place(sizes[i]);
    if (!place) return std::nullopt;
    places[i] = *place;
  }
  return places;
}

}  // namespace scantrove
