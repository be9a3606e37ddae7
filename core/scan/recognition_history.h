#pragma once
#include <map>
#include <optional>

#include "core/catalogue/detector.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// What several looks at the same regions said about which object of the catalogue they are. One look may be
/// wrong, and one from a new side says little against an object.
class RecognitionHistory {
 public:
  static constexpr int kAttemptsToKnow = 2;    ///< that name the same object
  static constexpr int kAttemptsToGiveUp = 4;  ///< that name none
  static constexpr int kFramesApart = 4;       ///< between two looks
  static constexpr int kMemory = 900;          ///< frames
  /// One look is enough where the distance is below this part of the greatest that counts.
  static constexpr float kSurePart = 0.5F;

  /// The regions were looked up in frame `frame`.
  void add(const RegionSet& regions, const DetectionMatch& match, float max_distance, int frame);
  [[nodiscard]] bool isAttemptDue(const RegionSet& regions, int frame) const;
  [[nodiscard]] int observations(const RegionSet& regions) const;

  /// The object that they are; none: no object that is known. Empty: more looks are needed.
  [[nodiscard]] std::optional<ObjectId> verdict(const RegionSet& regions) const;

  /// The region was joined into another: what was seen of it is not what is to be seen.
  void forgetRegion(RegionId region);
  void forgetBefore(int frame);

 private:
  friend class CollectorMemory;
  struct Votes {
    int observations = 0;
    bool sure = false;
  };
  struct Tally {
    int observations = 0;
    int last_frame = 0;
    std::map<ObjectId, Votes> votes;
  };
  std::map<RegionSet, Tally> tallies_;
};

}  // namespace scantrove
