#pragma once
#include <Eigen/Core>
#include <functional>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/catalogue/view_sphere.h"
#include "core/discovery/candidate.h"
#include "core/fusion/depth_view.h"

namespace scantrove {

/// The objects that a scan has met: which regions they are, where they stand, and from where views of them
/// were kept. An object is remembered as it was taken for; who holds it now, after merges and deletions, is
/// for the catalogue to say.
class MetObjects {
 public:
  struct Met {
    Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();  ///< newest sighting
    Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
    int last_frame = 0;
    int times_empty = 0;  ///< frames since then that saw through its place
    ViewSphere views;
  };

  /// The regions are this object, whatever they were before.
  void bind(const RegionSet& regions, ObjectId object);
  /// Those of the regions that are the object are of none any more.
  void unbind(const RegionSet& regions, ObjectId object);
  /// There is no such object: its regions are of none, and nothing is known of its place.
  void forget(ObjectId object);
  [[nodiscard]] bool hasRegions(ObjectId object) const { return !regionsOf(object).empty(); }
  [[nodiscard]] std::vector<RegionId> regionsOf(ObjectId object) const;
  /// The object of all those of the regions that are of any; none where they are of none, or of several.
  [[nodiscard]] ObjectId objectOf(const RegionSet& regions) const;
  [[nodiscard]] ObjectId objectOf(RegionId region) const;

  /// `from` is now part of `into`. Returns the two objects that they were, when they were two.
  [[nodiscard]] std::pair<ObjectId, ObjectId> regionsJoined(RegionId into, RegionId from);

  /// Another sighting.
  void meet(ObjectId object, const Candidate& candidate, int frame);
  /// What stands there is not quite what it was taken for; at least it has not left.
  void stillThere(ObjectId object, int frame);
  /// Looks at the places of all objects that are in view but were not met in this frame. A place is empty
  /// when the readings around the object's middle lie behind it. `depth_noise_m`: FusionParams.
  void lookAtPlaces(const DepthView& now, float depth_noise_m, int frame);
  /// Its place was seen empty several times: it has been taken away.
  [[nodiscard]] static bool wasRemoved(const Met& met) { return met.times_empty >= kTimesEmpty; }
  [[nodiscard]] Met& met(ObjectId object) { return met_[object]; }
  [[nodiscard]] const std::map<ObjectId, Met>& all() const { return met_; }

  /// The nearest object that stands where the candidate is, is about as large, `may_be_it`, and was not seen
  /// since `frame`: one that was is there under regions of its own.
  [[nodiscard]] ObjectId nearby(const Candidate& candidate, int frame,
                                const std::function<bool(ObjectId)>& may_be_it) const;
  /// It stands where the candidate is and is about as large.
  [[nodiscard]] bool isAt(ObjectId object, const Candidate& candidate) const;

 private:
  friend class CollectorMemory;
  static constexpr int kTimesEmpty = 3;

  std::map<ObjectId, Met> met_;
  std::unordered_map<RegionId, ObjectId> object_of_region_;  // stays when the object is deleted
};

}  // namespace scantrove
