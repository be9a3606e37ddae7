#pragma once
#include <map>
#include <optional>
#include <utility>

#include "core/catalogue/detector.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// Which object of the catalogue some regions are, by several look-ups. One may be wrong, and one from a new
/// side says little against an object.
class RecognitionHistory {
 public:
  static constexpr int kAttemptsToKnow = 2;    ///< that name the same object
  static constexpr int kAttemptsToGiveUp = 4;  ///< that name none
  static constexpr int kFramesApart = 4;       ///< between two look-ups
  static constexpr int kMemory = 900;          ///< frames
  /// One look-up is enough where the distance is below this part of the greatest that counts.
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

  /// The regions were looked up in frame `frame`.
  void add(const RegionSet& regions, const DetectionMatch& match, float max_distance, int frame);
  [[nodiscard]] bool isAttemptDue(const RegionSet& regions, int frame) const;
  [[nodiscard]] int attempts(const RegionSet& regions) const;

  /// The object that they are; none: no object that is known. Empty: more look-ups are needed.
  [[nodiscard]] std::optional<ObjectId> verdict(const RegionSet& regions) const;

  /// The region is part of another now: earlier look-ups showed something else.
  void forgetRegion(RegionId region);
  void forgetBefore(int frame);

 private:
  Tallies tallies_;
};

}  // namespace scantrove
