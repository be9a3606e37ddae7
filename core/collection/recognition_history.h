#pragma once
#include <map>
#include <optional>
#include <utility>

#include "core/catalogue/detector.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// Identifies regions by several comparisons with the catalogue. A single one may be wrong, and a failed
/// one from a new side says little.
class RecognitionHistory {
 public:
  static constexpr int kAttemptsToKnow = 2;    ///< that find the same object
  static constexpr int kAttemptsToGiveUp = 4;  ///< that find none
  static constexpr int kFramesApart = 4;       ///< between two comparisons
  static constexpr int kMemory = 900;          ///< frames
  /// One comparison is enough if its distance is below this fraction of the threshold.
  static constexpr float kSurePart = 0.5F;

  struct Votes {
    int attempts = 0;
    bool sure = false;
  };
  struct Tally {
    int attempts = 0;
    int last_frame = 0;
    std::map<ObjectId, Votes> votes;
  };
  using Tallies = std::map<RegionSet, Tally>;

  RecognitionHistory() = default;
  explicit RecognitionHistory(Tallies tallies) : tallies_(std::move(tallies)) {}
  [[nodiscard]] const Tallies& tallies() const { return tallies_; }

  /// The regions were compared in frame `frame`.
  void add(const RegionSet& regions, const DetectionMatch& match, float max_distance, int frame);
  [[nodiscard]] bool isAttemptDue(const RegionSet& regions, int frame) const;
  [[nodiscard]] int attempts(const RegionSet& regions) const;

  /// The object of the regions; none: no known object. Empty: more comparisons are needed.
  [[nodiscard]] std::optional<ObjectId> verdict(const RegionSet& regions) const;

  /// The region is part of another now: earlier comparisons showed something else.
  void forgetRegion(RegionId region);
  void forgetBefore(int frame);

 private:
  Tallies tallies_;
};

}  // namespace scantrove
