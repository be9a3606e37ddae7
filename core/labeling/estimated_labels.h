#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Fragments of surface that no depth image shows (shiny, dark, transparent), at estimated places. They lie
/// in cells of their own and never in the map's voxels: a measurement at the same place, or one that sees
/// through it, removes them. One thread.
class EstimatedLabels {
 public:
  explicit EstimatedLabels(float voxel_size_m) : cell_m_(kVoxelsPerCell * voxel_size_m) {}

  /// Fills pixels of `view` that have no surface with the vertices and fragments of cells that are seen
  /// there, and marks them in `view.is_estimated`. The image sizes are those of view.K.
  void project(RenderedView& view) const;

  /// Writes the fragments of the estimated pixels of `view` into their cells, and removes cells that the
  /// measured surface of `view` contradicts. A cell changes its fragment only after as many frames as said
  /// the other one before, at most eight.
  void update(const RenderedView& view, std::span<const FragmentId> fragments);

  /// Number of cells of each fragment, by fragment number; may end before the highest number.
  [[nodiscard]] const std::vector<int>& cellsOfFragments() const { return counts_; }
  [[nodiscard]] bool isEmpty() const { return bricks_.empty(); }

 private:
  static constexpr int kVoxelsPerCell = 2;
  static constexpr int kShift = 3, kSide = 1 << kShift;  ///< cells in a brick
  static constexpr std::size_t kCells = std::size_t{kSide} * kSide * kSide;
  struct Cell {
    FragmentId fragment;
    std::uint8_t confidence = 0;
  };
  struct Brick {
    std::array<Cell, kCells> cells{};
    int used = 0;
  };
  struct Hash {
    std::size_t operator()(const Eigen::Vector3i& brick) const noexcept;
  };

  /// Calls `visit(brick, cell, u, v, z, vertex)` with each used cell that projects into the view.
  template <class Bricks, class Visit>
  void forVisible(Bricks& bricks, const RenderedView& view, const Visit& visit) const;
  [[nodiscard]] Eigen::Vector3f centerOf(const Eigen::Vector3i& brick, std::size_t cell) const;
  void set(const Eigen::Vector3f& vertex_world, FragmentId fragment);
  void count(FragmentId fragment, int more);

  float cell_m_;
  std::unordered_map<Eigen::Vector3i, Brick, Hash> bricks_;
  std::vector<int> counts_;  // cells by fragment
};

}  // namespace scantrove
