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
/// earlier scans, and objects that were carried elsewhere in this one. Where earlier scans saw an object at
/// the same place, less likeness is enough. May throw cl::Error.
class Recognizer {
 public:
  /// Candidates that are looked up in one frame at most: bounds the time.
  static constexpr std::size_t kMaxLookUps = 4;

  /// What a session keeps.
  struct State {
    RecognitionHistory history;
    std::set<ObjectId> returned;  ///< missing objects that appeared ones were recognised as
    /// Objects that appeared in the scene; how often each missing one was compared with them.
    std::map<ObjectId, std::map<ObjectId, int>> appeared;
    std::map<ObjectId, int> comparisons;  ///< with objects of earlier scans, while a scan is refined
  };

  /// All outlive the recogniser.
  Recognizer(CatalogueMirror& catalogue, const ObjectTracks& tracks, const UserRequests& requests,
             State state = {})
      : catalogue_(catalogue), tracks_(tracks), requests_(requests), state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }
  void setParams(const DetectionParams& params);

  /// The device code is made before it is needed.
  void warmUp() { catalogue_.detector().warmUp(); }
  /// Looks up those of the unidentified candidates that were not looked up lately.
  void lookUp(std::vector<const Candidate*> unidentified, const ObservedFrame& observed, int frame);
  /// The object that the regions are; none: no object that is known. Empty: more frames are needed.
  [[nodiscard]] std::optional<ObjectId> verdict(const RegionSet& regions) const {
    return state_.history.verdict(regions);
  }
  /// That an object was taken away may be seen only after it was put elsewhere, and became another one there.
  [[nodiscard]] std::vector<SameObjects> compareAppeared(const std::vector<Candidate>& candidates,
                                                         const ObservedFrame& observed);
  /// While a scan is refined: objects that this scan took for new, but that clearly look like an object of an
  /// earlier scan that was not observed yet. Earlier frames may have shown a part of it; and the place may be
  /// known only by now. `observed_objects`: candidates that are objects in this frame.
  [[nodiscard]] std::vector<SameObjects> compareWithEarlierScans(
      const std::vector<const Candidate*>& observed_objects, const ObservedFrame& observed);
  void forgetComparisons() { state_.comparisons.clear(); }
  /// Finds out whether earlier scans saw this place, by where the recognised objects are.
  void alignWithEarlierScans();

  /// The object has appeared in the scene while it was watched.
  void noteAppeared(ObjectId object) { state_.appeared.try_emplace(object); }
  [[nodiscard]] bool hasAppeared(ObjectId object) const { return state_.appeared.contains(object); }
  /// An object that appeared was recognised as it.
  [[nodiscard]] bool hasReturned(ObjectId root) const;

  void forgetRegion(RegionId region) { state_.history.forgetRegion(region); }
  void forgetBefore(int frame) { state_.history.forgetBefore(frame); }

 private:
  /// The match of a candidate that appeared, of `missing` objects perhaps one.
  [[nodiscard]] DetectionMatch matchMissing(DetectionMatch match, std::size_t missing);
  /// What earlier scans saw at the candidate's place, about as large, and this one has not observed yet.
  [[nodiscard]] std::vector<ObjectId> expectedAt(const Candidate& candidate) const;

  CatalogueMirror& catalogue_;
  const ObjectTracks& tracks_;
  const UserRequests& requests_;
  float max_distance_ = 0;  // DetectionParams
  State state_;
};

}  // namespace scantrove
