#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/catalogue/view_sketch.h"

namespace scantrove {

/// The sketches of all views of a large catalogue, and the search that reads them all: 128 bytes a view.
/// Views are identified by index, 0 .. size() - 1. One thread.
///
/// A plain scan: views join and leave at no cost, nothing is built at the start, and 100,000 views take less
/// than a millisecond. docs/benchmarks.md has the figures.
class ViewSketches {
 public:
  struct Near {
    float distance;  ///< about matchDistance() without a network
    float shape;     ///< about ViewDifference::shape
    int place;
  };

  [[nodiscard]] int size() const { return size_; }
  void append(const ViewSketch& sketch);

  /// The `most` nearest of those views that `counts` accepts, in any order. It is asked only about views
  /// that are near.
  [[nodiscard]] std::vector<Near> nearest(const ViewSketch& query, std::size_t most,
                                          const std::function<bool(int)>& counts) const;
  /// Those of `places`, which ascend, in that order.
  [[nodiscard]] std::vector<Near> at(const ViewSketch& query, std::span<const int> places) const;

 private:
  static constexpr std::size_t kLanes = 32;  // views that are compared at once
  template <class T>
  using Lanes = std::array<T, kLanes>;
  /// Views side by side, so that one instruction compares several.
  struct Block {
    std::array<Lanes<std::int16_t>, ViewSketch::kNumbers> numbers{};
    Lanes<float> length{};
    Lanes<float> shape_energy{};  // of the coordinates, in the thumbnail's own length
    Lanes<float> color_energy{};  // of the coordinates
    Lanes<float> has_size{};      // 1 or 0
    std::array<Lanes<float>, 4> log_sizes{};
  };
  struct Compared {
    Lanes<float> distance, shape;
  };
  struct Query;

  static void compare(const Block& block, const Query& query, Compared& compared);

  std::vector<Block> blocks_;
  int size_ = 0;
};

}  // namespace scantrove
