#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/geometry/view_coverage.h"

namespace scantrove {

/// What happened to regions in one frame.
struct RegionEvents {
  std::vector<std::pair<RegionId, RegionId>> joined;  ///< (into, from): `from` is no more
  std::vector<std::pair<RegionId, RegionId>> parted;  ///< (from, part): `part` is new, `from` goes on
};

/// A fragment goes from one region to another.
struct RegionMove {
  FragmentId fragment;
  RegionId before, after;
  bool operator==(const RegionMove&) const = default;
};

/// What a person said that a region is.
enum class UserLabel {
  nothing,
  background,  ///< nothing by itself; it may be joined with others of that kind
  thing        ///< a thing of its own
};

/// Fragment -> region. Voxels hold fragments; joining or parting regions changes entries here and reaches
/// every voxel, seen or not. One thread.
///
/// Fragment numbers are used again after free(); region numbers never.
class RegionTable {
 public:
  /// A fragment that no voxel holds yet: a region of its own.
  FragmentId newFragment();
  /// A fragment that no voxel holds yet, cut out of `fragment`: of the same region, seen from the same sides.
  FragmentId newFragmentBeside(FragmentId fragment);
  /// A fragment that no voxel holds any more.
  void free(FragmentId fragment);

  /// Region of a fragment; none for none, and for a fragment that is free.
  [[nodiscard]] RegionId regionOf(FragmentId fragment) const { return regions_.at(fragment.value); }
  /// Region of every fragment, by fragment number, [0] = none.
  [[nodiscard]] const std::vector<RegionId>& regions() const { return regions_; }
  /// Fragments of a region, in rising order; empty for one that is no more.
  [[nodiscard]] std::span<const FragmentId> fragmentsOf(RegionId region) const;

  /// The fragment is seen from there: `direction` from it to the camera, world.
  void look(FragmentId fragment, const Eigen::Vector3f& direction) {
    seen_from_.at(fragment.value).look(direction);
  }
  /// From where it was seen; from nowhere: there is no such fragment.
  [[nodiscard]] ViewCoverage seenFrom(FragmentId fragment) const;
  /// Of all its fragments.
  [[nodiscard]] ViewCoverage seenFrom(RegionId region) const;
  void restoreSeen(FragmentId fragment, ViewCoverage seen_from) { seen_from_.at(fragment.value) = seen_from; }

  /// A region that a person or the catalogue knows: it keeps its identity when it is joined with others.
  void setKnown(RegionId region, bool known);
  [[nodiscard]] bool isKnown(RegionId region) const;
  /// What a person says of a region gives it an identity stronger than any other.
  void say(RegionId region, UserLabel said);
  [[nodiscard]] UserLabel said(RegionId region) const;

  /// All fragments of `from` become fragments of `into`. False when they are one already, or one is none.
  bool join(RegionId into, RegionId from);

  /// Divides the fragments of some whole regions anew: `parts` hold each of their fragments once. Of the
  /// parts of a region the one with most voxels keeps its identity; a part made of several regions takes that
  /// of one that a person said something of, else of a known one, else of the one that gives it most voxels.
  /// `voxels`: by fragment number.
  void divide(const std::vector<std::vector<FragmentId>>& parts, std::span<const int> voxels,
              RegionEvents& events);

  /// Moves those fragments that are still where `moves` has them before. Regions that were no more may come
  /// back by that, as the same.
  void move(std::span<const RegionMove> moves, RegionEvents& events);

  /// As it was when it was kept: region of each fragment, by fragment number, [0] = none; the highest region
  /// that ever was. Nothing is known or said of any.
  void restore(std::vector<RegionId> regions, RegionId last_region);
  /// The highest region that ever was.
  [[nodiscard]] RegionId lastRegion() const { return RegionId{last_region_}; }

  /// Grows with each change.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Those who keep a copy.
  enum class Follower { window, session };
  /// Fragments whose region changed since the follower's last call, each once.
  [[nodiscard]] std::vector<FragmentId> takeChanged(Follower follower = Follower::window);

 private:
  struct Region {
    std::vector<FragmentId> fragments;  // rising
    bool known = false;
    UserLabel said = UserLabel::nothing;
  };
  FragmentId takeNumber();
  RegionId newRegion();
  void assign(RegionId region, std::vector<FragmentId> fragments);
  void setRegion(FragmentId fragment, RegionId region);

  std::vector<RegionId> regions_{RegionId{}};
  std::vector<ViewCoverage> seen_from_{ViewCoverage{}};  // by fragment, as regions_
  std::vector<FragmentId> free_;                         // to be used again, lowest last
  std::map<RegionId, Region> members_;
  /// What a follower has not taken yet.
  struct Changes {
    std::vector<FragmentId> fragments;
    std::vector<bool> is_listed;  // by fragment
  };
  std::array<Changes, 2> changes_;  // by follower
  std::uint32_t last_region_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace scantrove
