#pragma once
#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "core/labeling/fragment_contacts.h"
#include "core/labeling/overlap_graph.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Finds fragments that turn out to hold two things: segments cut them along a fold, at the same place in
/// several looks. The more often one was seen, the more looks that takes: what is seen again and again is not
/// cut ever finer by the few looks that err alike. One thread.
class FragmentSplitter {
 public:
  static constexpr int kObservations = 3;  ///< that agree before a cut is made
  /// Of a fragment that was seen in so many frames.
  [[nodiscard]] static int observationsNeeded(int frames_seen);

  struct Split {
    FragmentId fragment;
    std::uint32_t segment;    ///< of this frame: the side that becomes a fragment of its own
    FragmentContact contact;  ///< between the two sides; its ids are those of the segments
  };

  /// `owner`: the fragment of each segment. Cuts that this frame completes, by fragment and segment.
  [[nodiscard]] std::vector<Split> find(const MergeInput& input, const OverlapGraph<FragmentId>& overlaps,
                                        std::span<const FragmentId> owner);
  void forget(FragmentId fragment);

 private:
  /// A side that was cut off in earlier looks.
  struct Pending {
    Eigen::Vector3f center_world = Eigen::Vector3f::Zero();
    float area_m2 = 0;
    int observations = 0;
    int age = 0;  ///< frames since the last look
  };
  [[nodiscard]] bool isConfirmed(FragmentId fragment, const Eigen::Vector3f& center_world, float area_m2);
  void agePending();

  std::map<FragmentId, std::vector<Pending>> pending_;
  std::vector<int> frames_seen_;  // by fragment: in which it has a side
};

}  // namespace scantrove
