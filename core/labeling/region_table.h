#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// What happened to regions in one frame.
struct RegionEvents {
  std::vector<std::pair<RegionId, RegionId>> joined;  ///< (into, from): `from` is no more
  std::vector<std::pair<RegionId, RegionId>> parted;  ///< (from, part): `part` is new, `from` goes on
};

/// Fragment -> region. Voxels hold fragments; joining or parting regions changes entries here and reaches
/// every voxel, seen or not. One thread.
///
/// Fragment numbers are used again after free(); region numbers never.
class RegionTable {
 public:
  /// A fragment that no voxel holds yet: a region of its own.
  FragmentId newFragment();
  /// A fragment that no voxel holds yet, cut out of `fragment`: of the same region.
  FragmentId newFragmentBeside(FragmentId fragment);
  /// A fragment that no voxel holds any more.
  void free(FragmentId fragment);

  /// Region of a fragment; none for none, and for a fragment that is free.
  [[nodiscard]] RegionId regionOf(FragmentId fragment) const { return regions_.at(fragment.value); }
  /// Region of every fragment, by fragment number, [0] = none.
  [[nodiscard]] const std::vector<RegionId>& regions() const { return regions_; }
  /// Fragments of a region, in rising order; empty for one that is no more.
  [[nodiscard]] std::span<const FragmentId> fragmentsOf(RegionId region) const;

  /// A region that a person or the catalogue knows: it keeps its identity when it is joined with others.
  void setKnown(RegionId region, bool known);
  [[nodiscard]] bool isKnown(RegionId region) const;

  /// All fragments of `from` become fragments of `into`. False when they are one already, or one is none.
  bool join(RegionId into, RegionId from);

  /// Divides the fragments of some whole regions anew: `parts` hold each of their fragments once. Of the
  /// parts of a region the one with most voxels keeps its identity; a part made of several regions takes that
  /// of a known one, else of the one that gives it most voxels. `voxels`: by fragment number.
  void divide(const std::vector<std::vector<FragmentId>>& parts, std::span<const int> voxels,
              RegionEvents& events);

  /// Grows with each change.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Fragments whose region changed since the last call, each once: for one who keeps a copy.
  [[nodiscard]] std::vector<FragmentId> takeChanged();

 private:
  struct Region {
    std::vector<FragmentId> fragments;  // rising
    bool known = false;
  };
  FragmentId takeNumber();
  RegionId newRegion();
  void assign(RegionId region, std::vector<FragmentId> fragments);
  void setRegion(FragmentId fragment, RegionId region);

  std::vector<RegionId> regions_{RegionId{}};
  std::vector<FragmentId> free_;  // to be used again, lowest last
  std::map<RegionId, Region> members_;
  std::vector<FragmentId> changed_;  // not taken yet
  std::vector<bool> is_changed_;     // by fragment
  std::uint32_t last_region_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace scantrove
