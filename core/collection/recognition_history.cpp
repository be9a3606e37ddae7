#include "core/collection/recognition_history.h"

#include <algorithm>

namespace scantrove {

void RecognitionHistory::add(const RegionSet& regions, const DetectionMatch& match, float max_distance,
                             int frame) {
  Tally& tally = tallies_[regions];
  ++tally.attempts;
  tally.last_frame = frame;
  if (!match.object) return;
  Votes& votes = tally.votes[match.object];
  ++votes.attempts;
  votes.sure = votes.sure || match.distance < kSurePart * max_distance;
}

bool RecognitionHistory::isAttemptDue(const RegionSet& regions, int frame) const {
  const auto found = tallies_.find(regions);
  return found == tallies_.end() || frame - found->second.last_frame >= kFramesApart;
}

int RecognitionHistory::attempts(const RegionSet& regions) const {
  const auto found = tallies_.find(regions);
  return found == tallies_.end() ? 0 : found->second.attempts;
}

std::optional<ObjectId> RecognitionHistory::verdict(const RegionSet& regions) const {
  const auto found = tallies_.find(regions);
  if (found == tallies_.end()) return std::nullopt;
  const Tally& tally = found->second;
  const auto best = std::ranges::max_element(tally.votes, {}, [](const auto& entry) {
    return entry.second.attempts + (entry.second.sure ? kAttemptsToKnow : 0);
  });
  if (best != tally.votes.end() && (best->second.sure || best->second.attempts >= kAttemptsToKnow))
    return best->first;
  // A single vote among many comparisons is chance.
  const int needed = tally.votes.empty() ? kAttemptsToGiveUp : 2 * kAttemptsToGiveUp;
  if (tally.attempts < needed) return std::nullopt;
  return ObjectId{};
}

void RecognitionHistory::forgetRegion(RegionId region) {
  std::erase_if(tallies_, [region](const auto& entry) { return entry.first.contains(region); });
}

void RecognitionHistory::forgetBefore(int frame) {
  std::erase_if(tallies_, [frame](const auto& entry) { return entry.second.last_frame < frame; });
}

}  // namespace scantrove
