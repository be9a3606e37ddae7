#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/fusion/kernels/brick_layout.h"
#include "core/fusion/rendered_view.h"
#include "core/geometry/position_order.h"

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

  /// Writes the fragments of the pixels that this frame estimated into their cells, and removes cells that
  /// the measured surface of `view` contradicts. A cell changes its fragment, or goes, only after as many
  /// frames as said the other one before, or estimated nothing there; at most eight. `estimated`: by pixel
  /// of `view`, SegmentMap::is_estimated; empty: the frame could not tell.
  void update(const RenderedView& view, std::span<const std::uint8_t> estimated,
              std::span<const FragmentId> fragments);

  /// Number of cells of each fragment, by fragment number; may end before the highest number.
  [[nodiscard]] const std::vector<int>& cellsOfFragments() const { return counts_; }
  [[nodiscard]] bool isEmpty() const { return bricks_.empty(); }

  /// Takes the centre of a cell (world, metres) and its fragment.
  using VisitCell = std::function<void(const Eigen::Vector3f& center_world, FragmentId fragment)>;
  /// Visits all used cells, in an order that depends only on their positions.
  void forEach(const VisitCell& visit) const;
  /// Visits the used cells in a brick of the map (brick_layout.h).
  void forEachIn(const Eigen::Vector3i& map_brick, const VisitCell& visit) const;
  /// Bricks of the map that may hold used cells.
  [[nodiscard]] std::vector<Eigen::Vector3i> mapBricks() const;
  /// Bricks of the map in which cells got another fragment, or none, since the last call.
  [[nodiscard]] std::vector<Eigen::Vector3i> takeChangedMapBricks();

  /// Cells of a cube of space, to be stored.
  struct StoredBrick {
    Eigen::Vector3i position = Eigen::Vector3i::Zero();
    /// Two for each used cell, in order; empty: the brick has no cells any more.
    std::vector<std::uint32_t> words;
  };
  /// Bricks that changed since the last call.
  [[nodiscard]] std::vector<StoredBrick> takeChanged();
  /// Whether stored words can be restored.
  [[nodiscard]] static bool isValid(const StoredBrick& stored);
  /// Adds the cells of a valid brick, but those of fragments without a region. `regions`: by fragment number.
  void restore(const StoredBrick& stored, std::span<const RegionId> regions);

 private:
  static constexpr int kVoxelsPerCell = 2;
  static constexpr int kShift = 3, kSide = 1 << kShift;              ///< cells in a brick
  static constexpr int kMapBrickSide = BRICK_SIDE / kVoxelsPerCell;  ///< cells in a brick of the map
  static constexpr int kMapBricks = kSide / kMapBrickSide;           ///< bricks of the map along a brick
  static constexpr std::size_t kCells = std::size_t{kSide} * kSide * kSide;
  struct Cell {
    FragmentId fragment;
    std::uint8_t confidence = 0;
    bool operator==(const Cell&) const = default;
  };
  struct Brick {
    std::array<Cell, kCells> cells{};
    int used = 0;
    bool is_changed = false;
  };
  /// In a fixed order: cells at equal depths must hide one another alike after a restore.
  using Bricks = std::map<Eigen::Vector3i, Brick, PositionOrder>;

  /// A cell in a view: its pixel, its depth and its centre.
  struct Seen {
    int u = 0, v = 0;
    float z_m = 0;
    Eigen::Vector3f vertex_world;
  };
  /// Calls `visit(entry of bricks, cell, seen)` with each used cell that projects into the view.
  template <class SomeBricks, class Visit>
  void forVisible(SomeBricks& bricks, const RenderedView& view, const Visit& visit) const;
  /// The place of a cell in its brick, in cells.
  [[nodiscard]] static Eigen::Vector3i placeOf(std::size_t cell);
  [[nodiscard]] Eigen::Vector3f centerOf(const Eigen::Vector3i& brick, std::size_t cell) const;
  void set(const Eigen::Vector3f& vertex_world, FragmentId fragment);
  /// One frame less says its fragment.
  void weaken(Bricks::value_type& entry, Cell& cell);
  /// Replaces a cell of a brick and counts.
  void change(Bricks::value_type& entry, Cell& cell, const Cell& to);

  float cell_m_;
  Bricks bricks_;
  std::vector<int> counts_;               // cells by fragment
  std::vector<Eigen::Vector3i> changed_;  // bricks, some of them gone
  std::set<Eigen::Vector3i, PositionOrder> changed_map_bricks_;
};

}  // namespace scantrove
