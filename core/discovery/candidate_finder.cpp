#include "core/discovery/candidate_finder.h"

#include <algorithm>
#include <functional>

#include "core/base/check.h"

namespace scantrove {

std::vector<std::size_t> chooseDisjoint(std::span<const Candidate> candidates, std::span<const float> known) {
  SCANTROVE_CHECK(candidates.size() == known.size());
  // With even odds a set and its regions are equally likely; regions join only at higher odds.
  constexpr float kEvenOdds = -1, kOfOdds = 0.1F, kMaxGain = 0.15F;
  const auto score = [&](std::size_t i) {
    const Candidate& candidate = candidates[i];
    const float together =
        candidate.regions.size() < 2 ? 0 : std::min(kOfOdds * (candidate.odds - kEvenOdds), kMaxGain);
    return known[i] + (candidate.is_complete ? 0.5F : 0.0F) + candidate.outline - candidate.hidden + together;
  };
  std::vector<std::size_t> order(candidates.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater<>(), score);
  std::vector<std::size_t> chosen;
  for (const std::size_t i : order) {
    const bool is_free = std::ranges::none_of(
        chosen, [&](std::size_t other) { return candidates[i].regions.overlaps(candidates[other].regions); });
    if (is_free) chosen.push_back(i);
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace scantrove
