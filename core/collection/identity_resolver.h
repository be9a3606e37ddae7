#pragma once
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/collection/object_tracks.h"
#include "core/collection/user_requests.h"
#include "core/discovery/candidate.h"

namespace scantrove {

/// Regions that are one complete object, and the frame (RgbdFrame::index) that shows it best.
struct CompleteSet {
  RegionSet regions;
  int best_frame = 0;
};

/// Two objects that are one.
struct SameObjects {
  ObjectId kept, gone;
};

/// Decides which candidates and objects are the same: by their regions, their places and what the recogniser
/// says. Merges objects of joined regions or of one place; an object that repeatedly shows another size is
/// given up and replaced.
class IdentityResolver {
 public:
  /// Who joined two regions: what frames say may be otherwise in the next.
  enum class JoinedBy { user, frames };
  /// Frames that a join by frames has to hold before the objects become one.
  static constexpr int kFramesToMerge = 300;

  /// What a candidate of some regions was taken for, and later observations that contradict it.
  struct Mismatch {
    ObjectId object;
    int count = 0;
    int last_frame = 0;
  };
  /// What a session keeps.
  struct State {
    std::map<RegionSet, Mismatch> mismatches;
    std::map<ObjectId, ObjectId> replaced_by;               ///< of objects with a mismatch
    std::set<std::pair<ObjectId, ObjectId>> seen_together;  ///< in one frame; smaller id first
    std::map<RegionSet, int> complete;                      ///< CompleteSet, while a scan is refined
  };

  /// All outlive the resolver.
  IdentityResolver(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks,
                   const UserRequests& requests, State state = {})
      : catalogue_(catalogue),
        writer_(writer),
        tracks_(tracks),
        requests_(requests),
        state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }

  /// The object that the candidate is, as far as is known. `verdict`: of the recogniser. `is_refining`:
  /// nothing moves any more.
  [[nodiscard]] ObjectId identityOf(const Candidate& candidate, std::optional<ObjectId> verdict, int frame,
                                    bool is_refining) const;
  /// The object that was at the candidate's place, and that may be it.
  [[nodiscard]] ObjectId nearby(const Candidate& candidate, int frame) const;

  // Mismatches: clear observations of what was taken for an object, but is not as large.

  /// After several in a row the regions are not the object any more.
  void countMismatch(const Candidate& candidate, ObjectId object, int frame);
  void clearMismatch(const RegionSet& regions) { state_.mismatches.erase(regions); }
  /// The object that the regions do not match; none: there is none.
  [[nodiscard]] ObjectId mismatchOf(const RegionSet& regions) const;
  /// The new `object` is where the mismatched one was thought to be. If that one is nowhere else, its views
  /// showed no object, or the same one: the map tells at the end of the scan.
  void replace(ObjectId mismatched, ObjectId object);
  /// What replaced the object in the end; the object itself if nothing did.
  [[nodiscard]] ObjectId replacementOf(ObjectId object) const;
  /// They are merged, or one replaced the other, and no user deleted that.
  [[nodiscard]] bool haveOneReplacement(ObjectId a, ObjectId b) const;
  /// Merges objects, of which valid views exist, with those that replaced them.
  void mergeReplaced(std::span<const ObjectId> with_views);
  void forgetBefore(int frame);

  // Merging.

  /// Both become one object with the next merge().
  void requestMerge(const SameObjects& same, int frame) {
    joins_.push_back({same.kept, same.gone, {}, frame});
  }
  /// Two objects at one place are one, the second was found under other regions; objects that were ever seen
  /// in one frame are two. `observed`: the candidates that are objects in this frame.
  void mergeDuplicates(const std::vector<const Candidate*>& observed, int frame);
  /// The region `from` is now part of `into`. If `into` was no object, it is the object of `from` if a user
  /// joined them or edited that; else only the place tells (nearby()).
  void joinRegions(RegionId into, RegionId from, JoinedBy by, int frame);
  /// `part` was a part of `from` until now. What a user deleted stays deleted in its parts.
  void splitRegion(RegionId from, RegionId part);
  enum class Which { held, all };  ///< joins that have held long enough, or all
  void merge(Which which, int frame);
  /// Objects of earlier scans that newly found ones were merged with, since the last call.
  [[nodiscard]] std::vector<ObjectRecord> takeRecognized() { return std::exchange(recognized_, {}); }

  // Complete sets.

  /// Each set takes the object that its regions were taken for, and none that another set has.
  void settle(std::span<const CompleteSet> complete);
  void forgetComplete() { state_.complete.clear(); }
  /// Their best frames.
  [[nodiscard]] const std::map<RegionSet, int>& complete() const { return state_.complete; }

 private:
  /// Objects whose regions were joined, or that are at one place.
  struct Join {
    ObjectId kept, gone;
    RegionId region;  // that holds both; none: they are one for good
    int frame = 0;
  };

  [[nodiscard]] bool isMismatched(const RegionSet& regions, ObjectId object) const;
  [[nodiscard]] bool areSeenTogether(ObjectId a, ObjectId b) const;
  /// The object is another complete set than these regions, and no user merged the two.
  [[nodiscard]] bool isOtherSet(ObjectId object, const RegionSet& regions) const;
  void mergeNow(ObjectId a, ObjectId b);

  CatalogueMirror& catalogue_;
  CatalogueWriter& writer_;
  ObjectTracks& tracks_;
  const UserRequests& requests_;
  State state_;
  std::vector<Join> joins_;
  std::vector<ObjectRecord> recognized_;
};

}  // namespace scantrove
