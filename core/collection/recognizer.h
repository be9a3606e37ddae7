#pragma once
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/collection/identity_resolver.h"
#include "core/collection/object_tracks.h"
#include "core/collection/observed_frame.h"
#include "core/collection/recognition_history.h"
#include "core/collection/user_requests.h"

namespace scantrove {

/// Recognises candidates as objects of the catalogue by their appearance, over several frames: objects of
/// earlier scans, and objects that moved during this one. Where an earlier scan saw an object at the same
/// place, less similarity is enough. May throw cl::Error.
class Recognizer {
 public:
  /// Maximum number of candidates compared per frame: bounds the time.
  static constexpr std::size_t kMaxLookUps = 4;

  /// The part that a session stores.
  struct State {
    RecognitionHistory history;
    std::set<ObjectId> returned;  ///< missing objects that appeared ones were recognised as
    /// Objects that appeared in the scene, and how often each missing one was compared with them.
    std::map<ObjectId, std::map<ObjectId, int>> appeared;
    std::map<ObjectId, int> comparisons;  ///< with objects of earlier scans, during refinement
  };

  /// All outlive this.
  Recognizer(CatalogueMirror& catalogue, const ObjectTracks& tracks, const UserRequests& requests,
             State state = {})
      : catalogue_(catalogue), tracks_(tracks), requests_(requests), state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }
  void setParams(const DetectionParams& params);

  /// Compiles the device code before its first use.
  void warmUp() { catalogue_.detector().warmUp(); }
  /// Compares the unidentified candidates that were not compared recently.
  void lookUp(std::vector<const Candidate*> unidentified, const ObservedFrame& observed, int frame);
  /// The object of the regions; none: no known object. Empty: more frames are needed.
  [[nodiscard]] std::optional<ObjectId> verdict(const RegionSet& regions) const {
    return state_.history.verdict(regions);
  }
  /// An object may be seen to be missing only after it was put elsewhere and became a new object there.
  [[nodiscard]] std::vector<SameObjects> compareAppeared(const std::vector<Candidate>& candidates,
                                                         const ObservedFrame& observed);
  /// During refinement: new objects of this scan that clearly look like an object of an earlier scan that
  /// was not observed yet. Earlier frames may have shown only a part, or the place was not recognised yet.
  /// `observed_objects`: candidates that are objects in this frame.
  [[nodiscard]] std::vector<SameObjects> compareWithEarlierScans(
      const std::vector<const Candidate*>& observed_objects, const ObservedFrame& observed);
  void forgetComparisons() { state_.comparisons.clear(); }
  /// Finds earlier scans of this place by the positions of the recognised objects.
  void alignWithEarlierScans();

  /// The object appeared in the scene during this scan.
  void noteAppeared(ObjectId object) { state_.appeared.try_emplace(object); }
  [[nodiscard]] bool hasAppeared(ObjectId object) const { return state_.appeared.contains(object); }
  /// An object that appeared was recognised as `object`.
  [[nodiscard]] bool hasReturned(ObjectId root) const;

  void forgetRegion(RegionId region) { state_.history.forgetRegion(region); }
  void forgetBefore(int frame) { state_.history.forgetBefore(frame); }

 private:
  /// Matches a candidate that appeared, perhaps one of the `missing` objects.
  [[nodiscard]] DetectionMatch matchMissing(DetectionMatch match, std::size_t missing);
  /// Objects that earlier scans saw at the candidate's place, about as large, and this scan has not
  /// observed yet.
  [[nodiscard]] std::vector<ObjectId> expectedAt(const Candidate& candidate) const;

  CatalogueMirror& catalogue_;
  const ObjectTracks& tracks_;
  const UserRequests& requests_;
  float max_distance_ = 0;  // DetectionParams
  State state_;
};

}  // namespace scantrove
