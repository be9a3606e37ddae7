#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/geometry/view_coverage.h"
#include "core/labeling/support_pixels.h"

namespace scantrove {

/// Changes of regions in one frame.
struct RegionEvents {
  std::vector<std::pair<RegionId, RegionId>> joined;  ///< (into, from): `from` no longer exists
  std::vector<std::pair<RegionId, RegionId>> parted;  ///< (from, part): `part` is new, `from` remains
};

/// A fragment moves from one region to another.
struct RegionMove {
  FragmentId fragment;
  RegionId before, after;
  bool operator==(const RegionMove&) const = default;
};

/// A person's label of a region.
enum class UserLabel {
  nothing,
  background,  ///< stuff; may be joined with other background
  object       ///< an object of its own
};

/// Fragment -> region. Voxels hold fragments, so joining or splitting regions here affects every voxel, in
/// view or not. One thread.
///
/// Fragment numbers are reused after free(); region numbers never.
class RegionTable {
 public:
  /// A new fragment without voxels, in a new region.
  FragmentId newFragment();
  /// A new fragment without voxels, split from `fragment`: same region, same view coverage. How it
  /// was seen on supports is not known: a cup that parts from the table is no support.
  FragmentId newFragmentBeside(FragmentId fragment);
  /// Frees a fragment that no voxel holds any more.
  void free(FragmentId fragment);

  /// Region of a fragment; none for no fragment or a free one.
  [[nodiscard]] RegionId regionOf(FragmentId fragment) const { return regions_.at(fragment.value); }
  /// Region of every fragment, by fragment number, [0] = none.
  [[nodiscard]] const std::vector<RegionId>& regions() const { return regions_; }
  /// Fragments of a region, in rising order; empty if it no longer exists.
  [[nodiscard]] std::span<const FragmentId> fragmentsOf(RegionId region) const;

  /// Records that the fragment is seen; `direction`: from it to the camera, world.
  void addViewDirection(FragmentId fragment, const Eigen::Vector3f& direction) {
    seen_from_.at(fragment.value).addDirection(direction);
  }
  /// View coverage of a fragment; empty if it does not exist.
  [[nodiscard]] ViewCoverage seenFrom(FragmentId fragment) const;
  /// View coverage of all its fragments.
  [[nodiscard]] ViewCoverage seenFrom(RegionId region) const;
  void restoreSeen(FragmentId fragment, ViewCoverage seen_from) { seen_from_.at(fragment.value) = seen_from; }

  void addSupportPixels(FragmentId fragment, const SupportPixels& pixels) {
    support_pixels_.at(fragment.value) += pixels;
  }
  /// How often a fragment was seen as a support or on one; zero if it does not exist.
  [[nodiscard]] SupportPixels supportPixels(FragmentId fragment) const;
  /// Of all its fragments.
  [[nodiscard]] SupportPixels supportPixels(RegionId region) const;

  /// A known region (of a person or the catalogue) keeps its identity when it is joined with others.
  void setKnown(RegionId region, bool known);
  [[nodiscard]] bool isKnown(RegionId region) const;
  /// Sets a person's label, which gives the region the strongest identity in joins.
  void setUserLabel(RegionId region, UserLabel label);
  [[nodiscard]] UserLabel userLabel(RegionId region) const;

  /// Moves all fragments of `from` to `into`. False if they are equal or one does not exist.
  bool join(RegionId into, RegionId from);

  /// Repartitions complete regions: `parts` hold each of their fragments once. The part with most voxels
  /// keeps its region's identity. A part made of several regions takes the identity of a region that a person
  /// labelled, else of a known one, else of the one with most voxels in it. `voxels`: by fragment number.
  void divide(const std::vector<std::vector<FragmentId>>& parts, std::span<const int> voxels,
              RegionEvents& events);

  /// Moves each fragment that is still in its RegionMove::before. This can restore a former region under its
  /// old number.
  void move(std::span<const RegionMove> moves, RegionEvents& events);

  /// Makes some fragments of one region, but not all, a new region. Returns it.
  RegionId separate(std::span<const FragmentId> fragments, RegionEvents& events);

  /// Restores a stored table: the region of each fragment, by fragment number, [0] = none, and the highest
  /// region number ever used. No region is known or labelled afterwards.
  void restore(std::vector<RegionId> regions, RegionId last_region);
  /// The highest region number ever used.
  [[nodiscard]] RegionId lastRegion() const { return RegionId{last_region_}; }

  /// Increases with each change.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Consumers that keep a copy.
  enum class Reader { window, session };
  /// Fragments whose region changed since the reader's last call, each once.
  [[nodiscard]] std::vector<FragmentId> takeChanged(Reader reader = Reader::window);

 private:
  struct Region {
    std::vector<FragmentId> fragments;  // rising
    bool known = false;
    UserLabel label = UserLabel::nothing;
  };
  FragmentId takeNumber();
  RegionId newRegion();
  void assign(RegionId region, std::vector<FragmentId> fragments);
  void setRegion(FragmentId fragment, RegionId region);

  std::vector<RegionId> regions_{RegionId{}};
  std::vector<ViewCoverage> seen_from_{ViewCoverage{}};         // by fragment, as regions_
  std::vector<SupportPixels> support_pixels_{SupportPixels{}};  // by fragment, as regions_
  std::vector<FragmentId> free_;                                // for reuse, lowest last
  std::map<RegionId, Region> members_;
  /// Changes that a reader has not taken yet.
  struct Changes {
    std::vector<FragmentId> fragments;
    std::vector<bool> is_listed;  // by fragment
  };
  std::array<Changes, 2> changes_;  // by reader
  std::uint32_t last_region_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace scantrove
