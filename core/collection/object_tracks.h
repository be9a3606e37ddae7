#pragma once
#include <Eigen/Core>
#include <functional>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/discovery/candidate.h"
#include "core/fusion/depth_view.h"
#include "core/geometry/view_sphere.h"

namespace scantrove {

/// An object of the catalogue that this scan follows.
struct ObjectTrack {
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();  ///< newest observation
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
  int last_frame = 0;
  int frames_empty = 0;  ///< frames since then that saw through its place
  ViewSphere views;      ///< directions of the stored views

  static constexpr int kFramesEmpty = 3;
  /// Its place was seen empty several times: the object was taken away.
  [[nodiscard]] bool isMissing() const { return frames_empty >= kFramesEmpty; }
};

/// The objects that a scan follows, with their regions and places. A track stays with the object that it
/// was started for. The catalogue tells which object that is part of after merges, and whether it was
/// deleted.
class ObjectTracks {
 public:
  /// The part that a session stores.
  struct State {
    std::map<ObjectId, ObjectTrack> tracks;
    std::unordered_map<RegionId, ObjectId> object_of_region;  ///< stays when the object is deleted
    std::set<ObjectId> moved;                                 ///< observed elsewhere than before
  };

  /// `catalogue` outlives this.
  explicit ObjectTracks(const CatalogueMirror& catalogue, State state = {})
      : catalogue_(catalogue), state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }

  // Regions.

  /// Assigns the regions to the object, whatever they were before.
  void bind(const RegionSet& regions, ObjectId object);
  /// Frees those of the regions that are assigned to the object.
  void unbind(const RegionSet& regions, ObjectId object);
  /// Frees all regions of the object and ends its track.
  void forget(ObjectId object);
  [[nodiscard]] std::vector<RegionId> regionsOf(ObjectId object) const;
  [[nodiscard]] bool hasRegions(ObjectId object) const { return !regionsOf(object).empty(); }
  /// The only object that any of the regions is assigned to; none: no object or several.
  [[nodiscard]] ObjectId objectOf(const RegionSet& regions) const;
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// As above; none also if the object is no longer in the catalogue.
  [[nodiscard]] ObjectId existingObjectOf(RegionId region) const;
  /// Whether the catalogue has one object for all of these regions.
  [[nodiscard]] bool areOneObject(const RegionSet& regions) const;
  /// `from` is now part of `into`. Returns their two objects if these differed.
  [[nodiscard]] std::pair<ObjectId, ObjectId> joinRegions(RegionId into, RegionId from);
  /// All regions that the next frame shows, candidates or not.
  void setRegionsInView(std::vector<RegionId> regions) { in_view_ = std::move(regions); }
  /// Whether another region in view than these is assigned to the object.
  [[nodiscard]] bool isInViewBeside(ObjectId object, const RegionSet& regions) const;

  // Places.

  /// The candidate is this object in this frame.
  void observe(ObjectId object, const Candidate& candidate, int frame);
  /// The object differs from the expectation in this frame, but is still there.
  void keepAlive(ObjectId object, int frame);
  /// Checks the places of all tracks in view that were not observed in this frame. A place is empty if the
  /// readings around the object's centre lie behind it. `depth_noise_m`: FusionParams.
  void checkPlaces(const DepthView& now, float depth_noise_m, int frame);
  [[nodiscard]] const std::map<ObjectId, ObjectTrack>& all() const { return state_.tracks; }
  /// Directions of the object's stored views.
  [[nodiscard]] ViewSphere& viewsOf(ObjectId object) { return state_.tracks[object].views; }
  /// The nearest object at the candidate's place that has about its size, fulfils `matches`, and was last
  /// observed before `frame`.
  [[nodiscard]] ObjectId nearest(const Candidate& candidate, int frame,
                                 const std::function<bool(ObjectId)>& matches) const;
  /// Whether the object is at the candidate's place and about as large.
  [[nodiscard]] bool isAt(ObjectId object, const Candidate& candidate) const;

  // Objects in the catalogue's current state. `root`: CatalogueMirror::mergeRootOf.

  [[nodiscard]] bool isObserved(ObjectId root) const;
  /// The object has left the place where the scan first observed it.
  [[nodiscard]] bool hasMoved(ObjectId object) const;
  /// Roots of the objects that were taken away, ascending.
  [[nodiscard]] std::vector<ObjectId> missing() const;

 private:
  const CatalogueMirror& catalogue_;
  State state_;
  std::vector<RegionId> in_view_;
};

}  // namespace scantrove
