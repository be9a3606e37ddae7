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
  ViewSphere views;      ///< directions of the views that were stored

  static constexpr int kFramesEmpty = 3;
  /// Its place was seen empty several times: it was taken away.
  [[nodiscard]] bool isMissing() const { return frames_empty >= kFramesEmpty; }
};

/// The objects that a scan follows: which regions they hold and where they are. A track stays with the object
/// that it was begun for; the catalogue says which object that is part of after merges, and whether it was
/// deleted.
class ObjectTracks {
 public:
  /// What a session keeps.
  struct State {
    std::map<ObjectId, ObjectTrack> tracks;
    std::unordered_map<RegionId, ObjectId> object_of_region;  ///< stays when the object is deleted
    std::set<ObjectId> moved;                                 ///< were observed elsewhere than before
  };

  /// `catalogue` outlives the tracks.
  explicit ObjectTracks(const CatalogueMirror& catalogue, State state = {})
      : catalogue_(catalogue), state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }

  // Regions.

  /// The regions are this object, whatever they were before.
  void bind(const RegionSet& regions, ObjectId object);
  /// Those of the regions that are the object are of none any more.
  void unbind(const RegionSet& regions, ObjectId object);
  /// There is no such object: its regions are of none, and its track ends.
  void forget(ObjectId object);
  [[nodiscard]] std::vector<RegionId> regionsOf(ObjectId object) const;
  [[nodiscard]] bool hasRegions(ObjectId object) const { return !regionsOf(object).empty(); }
  /// The object of all those of the regions that are of any; none where they are of none, or of several.
  [[nodiscard]] ObjectId objectOf(const RegionSet& regions) const;
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// The same; none also where the catalogue has it no longer.
  [[nodiscard]] ObjectId existingObjectOf(RegionId region) const;
  /// The catalogue has one object for all of these.
  [[nodiscard]] bool areOneObject(const RegionSet& regions) const;
  /// `from` is now part of `into`. Returns the two objects that they were, if they were two.
  [[nodiscard]] std::pair<ObjectId, ObjectId> joinRegions(RegionId into, RegionId from);
  /// All regions that the next frame shows, candidates or not.
  void setRegionsInView(std::vector<RegionId> regions) { in_view_ = std::move(regions); }
  /// Another region in view than these is the object.
  [[nodiscard]] bool isInViewBeside(ObjectId object, const RegionSet& regions) const;

  // Places.

  /// The candidate is the object, in this frame.
  void observe(ObjectId object, const Candidate& candidate, int frame);
  /// The object is not quite as expected in this frame, but still there.
  void keepAlive(ObjectId object, int frame);
  /// Checks the places of all tracks in view that were not observed in this frame. A place is empty where the
  /// readings around the object's middle lie behind it. `depth_noise_m`: FusionParams.
  void checkPlaces(const DepthView& now, float depth_noise_m, int frame);
  [[nodiscard]] const std::map<ObjectId, ObjectTrack>& all() const { return state_.tracks; }
  /// Directions of stored views of the object.
  [[nodiscard]] ViewSphere& viewsOf(ObjectId object) { return state_.tracks[object].views; }
  /// The nearest object that is where the candidate is, is about as large, fulfils `matches`, and was last
  /// observed before `frame`.
  [[nodiscard]] ObjectId nearest(const Candidate& candidate, int frame,
                                 const std::function<bool(ObjectId)>& matches) const;
  /// It is where the candidate is and about as large.
  [[nodiscard]] bool isAt(ObjectId object, const Candidate& candidate) const;

  // Objects as the catalogue has them now. `root`: CatalogueMirror::mergeRootOf.

  [[nodiscard]] bool isObserved(ObjectId root) const;
  /// The object is not any more where the scan first observed it.
  [[nodiscard]] bool hasMoved(ObjectId object) const;
  /// Roots of the objects that were taken away, rising.
  [[nodiscard]] std::vector<ObjectId> missing() const;

 private:
  const CatalogueMirror& catalogue_;
  State state_;
  std::vector<RegionId> in_view_;
};

}  // namespace scantrove
