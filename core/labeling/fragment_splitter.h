#pragma once
#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "core/labeling/fragment_contacts.h"
#include "core/labeling/overlap_graph.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Finds fragments that hold two objects: segments split them along a fold, at the same place in several
/// observations. A fragment seen more often needs more observations, so that a few errors at the same place
/// do not split it ever finer. One thread.
class FragmentSplitter {
 public:
  static constexpr int kObservations = 3;  ///< that must agree before a split
  /// The observations that must agree for a fragment seen in `frames_seen` frames.
  [[nodiscard]] static int observationsNeeded(int frames_seen);

  struct Split {
    FragmentId fragment;
    std::uint32_t segment;    ///< of this frame: the side that becomes a new fragment
    FragmentContact contact;  ///< between the two sides; its ids are those of the segments
  };

  /// The splits that this frame confirms, ordered by fragment and segment. `owner`: the fragment of each
  /// segment.
  [[nodiscard]] std::vector<Split> find(const MergeInput& input, const OverlapGraph<FragmentId>& overlaps,
                                        std::span<const FragmentId> owner);
  void forget(FragmentId fragment);

 private:
  /// A side that earlier observations separated.
  struct Pending {
    Eigen::Vector3f center_world = Eigen::Vector3f::Zero();
    float area_m2 = 0;
    int observations = 0;
    int age = 0;  ///< frames since the last observation
  };
  [[nodiscard]] bool isConfirmed(FragmentId fragment, const Eigen::Vector3f& center_world, float area_m2);
  void agePending();

  std::map<FragmentId, std::vector<Pending>> pending_;
  std::vector<int> frames_seen_;  // by fragment: frames in which it has a side
};

}  // namespace scantrove
