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

/// Regions that form one complete object, and the frame (RgbdFrame::index) that shows it best.
struct CompleteSet {
  RegionSet regions;
  int best_frame = 0;
};

/// Two entries of one object.
struct SameObjects {
  ObjectId kept, gone;
};

/// Decides which candidates and objects are the same, by regions, places and the recogniser's verdict.
/// Merges objects whose regions were joined or that share a place. Replaces an object that repeatedly shows
/// another size.
class IdentityResolver {
 public:
  /// Who joined two regions: a join by frames may be reverted in the next frame.
  enum class JoinedBy { user, frames };
  /// Frames that a join by frames must persist before the objects are merged.
  static constexpr int kFramesToMerge = 300;

  /// The object that some regions were identified as, and later observations that contradict it.
  struct Mismatch {
    ObjectId object;
    int count = 0;
    int last_frame = 0;
  };
  /// The part that a session stores.
  struct State {
    std::map<RegionSet, Mismatch> mismatches;
    std::map<ObjectId, ObjectId> replaced_by;               ///< mismatched objects and their replacements
    std::set<std::pair<ObjectId, ObjectId>> seen_together;  ///< in one frame; smaller id first
    std::map<RegionSet, int> complete;                      ///< CompleteSet, during refinement
  };

  /// All outlive this.
  IdentityResolver(CatalogueMirror& catalogue, CatalogueWriter& writer, ObjectTracks& tracks,
                   const UserRequests& requests, State state = {})
      : catalogue_(catalogue),
        writer_(writer),
        tracks_(tracks),
        requests_(requests),
        state_(std::move(state)) {}
  [[nodiscard]] const State& state() const { return state_; }

  /// The object that the candidate is, as far as known. `verdict` is the recogniser's. `is_refining`:
  /// nothing moves any more.
  [[nodiscard]] ObjectId identityOf(const Candidate& candidate, std::optional<ObjectId> verdict, int frame,
                                    bool is_refining) const;
  /// An object last observed at the candidate's place that may be the candidate.
  [[nodiscard]] ObjectId nearby(const Candidate& candidate, int frame) const;

  // Mismatches: clear observations of an identified object that is not as large as expected.

  /// After several mismatches in a row the regions are no longer that object.
  void countMismatch(const Candidate& candidate, ObjectId object, int frame);
  void clearMismatch(const RegionSet& regions) { state_.mismatches.erase(regions); }
  /// The object that the regions do not match; none: no mismatch.
  [[nodiscard]] ObjectId mismatchOf(const RegionSet& regions) const;
  /// The new `object` is at the place of the mismatched one. If the mismatched one is not found elsewhere,
  /// the refinement decides whether its views showed the same object or none.
  void replace(ObjectId mismatched, ObjectId object);
  /// The last replacement of the object; the object itself if it was not replaced.
  [[nodiscard]] ObjectId replacementOf(ObjectId object) const;
  /// Whether the two are merged or one replaced the other, and no user deleted the result.
  [[nodiscard]] bool haveOneReplacement(ObjectId a, ObjectId b) const;
  /// Merges replaced objects that still have valid views with their replacements.
  void mergeReplaced(std::span<const ObjectId> with_views);
  void forgetBefore(int frame);

  // Merging.

  /// Both become one object with the next merge().
  void requestMerge(const SameObjects& same, int frame) {
    joins_.push_back({same.kept, same.gone, {}, frame});
  }
  /// Merges two objects at one place, of which the second was found under other regions. Objects that were
  /// ever seen in one frame stay two. `observed`: the candidates that are objects in this frame.
  void mergeDuplicates(const std::vector<const Candidate*>& observed, int frame);
  /// The region `from` is now part of `into`. If `into` was no object, it becomes the object of `from` if a
  /// user joined them or edited that object. Otherwise only the place decides (nearby()). `operation`: the
  /// number of a user's join: two objects become one at once, also if users settled both, because a user
  /// joined their regions (as in saved scans). 0: merge() decides.
  void joinRegions(RegionId into, RegionId from, JoinedBy by, int frame, int operation = 0);
  /// A user undid that join. The regions are `objects` again, and merged objects are separate again.
  /// `earlier`: its merges, if an earlier scan made them.
  void partRegions(int operation, const std::map<RegionId, ObjectId>& objects,
                   std::vector<ObjectMerge> earlier);
  /// `part` was part of `from` until now. An object that a user deleted stays deleted for its parts.
  void splitRegion(RegionId from, RegionId part);
  enum class Which { held, all };  ///< joins that persisted long enough, or all
  void merge(Which which, int frame);
  /// Objects of earlier scans that new objects were merged with, since the last call.
  [[nodiscard]] std::vector<ObjectRecord> takeRecognized() { return std::exchange(recognized_, {}); }

  // Complete sets.

  /// Each set takes the object that its regions were identified as, unless another set has it.
  void settle(std::span<const CompleteSet> complete);
  void forgetComplete() { state_.complete.clear(); }
  /// Complete sets with their best frames.
  [[nodiscard]] const std::map<RegionSet, int>& complete() const { return state_.complete; }

 private:
  /// Objects whose regions were joined, or that share a place.
  struct Join {
    ObjectId kept, gone;
    RegionId region;  // holds both; none: the join is final
    int frame = 0;
  };

  [[nodiscard]] bool isMismatched(const RegionSet& regions, ObjectId object) const;
  [[nodiscard]] bool areSeenTogether(ObjectId a, ObjectId b) const;
  /// The object is another complete set than these regions, and no user merged the two.
  [[nodiscard]] bool isOtherSet(ObjectId object, const RegionSet& regions) const;
  /// `join`: CatalogueWriter::merge().
  void mergeNow(ObjectId a, ObjectId b, int join = 0);
  /// mergeNow() for objects of regions; notes an object of an earlier scan that was recognised by that.
  void mergeRecognized(ObjectId a, ObjectId b, int join = 0);

  CatalogueMirror& catalogue_;
  CatalogueWriter& writer_;
  ObjectTracks& tracks_;
  const UserRequests& requests_;
  State state_;
  std::vector<Join> joins_;
  std::vector<ObjectRecord> recognized_;
};

}  // namespace scantrove
