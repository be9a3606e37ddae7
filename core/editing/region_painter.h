#pragma once
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/editing/editable_regions.h"
#include "core/editing/painted_surface.h"

namespace scantrove {

/// Carries a correction of one image's mask to the regions behind it. Surface that was added moves from its
/// region to the painted one: all of it if the painted area covers nine tenths of what the image shows of it,
/// else the part that a minimum cut separates. What was painted out goes to the region that it continues
/// without a fold or a colour edge, else to a new one. The thread of the map; may throw cl::Error.
class RegionPainter {
 public:
  explicit RegionPainter(EditableRegions regions) : regions_(regions) {}

  /// Carries out a paint or an unpaint. Adds to `effect` moves, constraints, new regions and the anchor, and
  /// to `events` the changes. `painted` null: corrects the image alone, as does an unpaint. Returns the
  /// painted region, which may be new. On an error nothing changes: several regions, no pixels, no surface
  /// for a new region. Once for each painter.
  [[nodiscard]] Result<RegionId> apply(const Operation& operation, const PaintedSurface* painted,
                                       OperationEffect& effect, RegionEvents& events);

  /// Regions that lost or gained fragments, ascending.
  [[nodiscard]] const std::set<RegionId>& changed() const { return changed_; }

 private:
  using Fragments = EditableRegions::Fragments;
  /// Of the voxels of one region.
  struct Seeds {
    std::vector<std::uint32_t> going, staying;  ///< voxels that the image shows on one side
    std::vector<std::uint32_t> away;            ///< hidden ones, or beyond the image, that are not painted
    std::size_t hidden_behind = 0;              ///< hidden behind painted pixels
  };
  enum class Extent { none, part, all };

  /// What the image shows of a region within the added pixels.
  struct Shown {
    SurfaceGraph graph;
    Seeds seeds;
    Extent extent = Extent::none;
  };

  /// Adds to `effect` the constraints and new regions, and to `events` the changes. Surface below the
  /// resolution of the painting changes nothing.
  void paint(RegionId region, const PaintedSurface& painted, OperationEffect& effect, RegionEvents& events);

  /// Makes the surface that paint() would move from one region a region of its own, from the region that the
  /// added pixels show most of; paint() of the new region then adds the others. Error: the added pixels show
  /// no part of a region, but all of one or nothing. Then nothing changes.
  [[nodiscard]] Result<RegionId> create(const PaintedSurface& painted, OperationEffect& effect,
                                        RegionEvents& events);
  /// Moves of fragments from their regions before apply().
  [[nodiscard]] std::vector<RegionMove> moves() const;

  [[nodiscard]] Shown shownOf(RegionId region, std::span<const Eigen::Vector3f> places,
                              const PaintedSurface& painted) const;
  /// Cuts the added part of a region off: the second part of the result.
  [[nodiscard]] EditableRegions::Division cutOff(RegionId region, const Shown& shown);
  [[nodiscard]] Seeds seedsOf(const SurfaceGraph& graph, const PaintedSurface& painted,
                              PaintedSurface::Area going) const;
  [[nodiscard]] static Extent extentOf(const Seeds& seeds);
  void add(RegionId to, RegionId from, std::span<const Eigen::Vector3f> places,
           const PaintedSurface& painted);
  void join(RegionId to, RegionId from);
  void remove(RegionId region, const PaintedSurface& painted);
  /// Makes the piece, whose fragments are still of `region`, a part of another region or a new one.
  void give(RegionId region, const Fragments& piece, const Fragments& rest, RegionId continued);
  /// The region among `around` that the piece (voxels of `graph`) continues; none: it ends at folds or edges.
  [[nodiscard]] RegionId continuedBy(const SurfaceGraph& graph, std::span<const std::uint32_t> piece,
                                     std::span<const RegionId> around) const;
  [[nodiscard]] EditableRegions::Division divide(RegionId region, const SurfaceGraph& graph,
                                                 std::span<const std::uint32_t> part, std::size_t parts);
  void move(RegionId from, RegionId to, const Fragments& fragments);
  void remember(RegionId region);
  [[nodiscard]] Eigen::Vector3f centerOf(const SurfaceVoxel& voxel) const;

  EditableRegions regions_;
  OperationEffect* effect_ = nullptr;  // both only during apply()
  RegionEvents* events_ = nullptr;
  std::map<FragmentId, RegionId> before_;
  std::set<RegionId> changed_;
};

}  // namespace scantrove
