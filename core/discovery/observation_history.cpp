#include "core/discovery/observation_history.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace scantrove {
namespace {

constexpr float kOtherSize = 0.3F;        // the diagonal differs by this part
constexpr float kObservationMemory = 30;  // observations in the running means
constexpr int kObservationsToDiffer = 3;  // in a row

}  // namespace

void ObservationHistory::nextFrame() {
  ++frame_;
  std::erase_if(watched_, [&](const auto& entry) { return frame_ - entry.second.last_frame > kMemory; });
}

void ObservationHistory::add(const RegionSet& regions, const Observation& observation) {
  Watched& watched = watched_[regions];
  const float size_m = observation.size_m.norm();
  if (watched.observations > 0 &&
      std::abs(size_m - watched.size_m) > kOtherSize * std::max(size_m, watched.size_m)) {
    if (++watched.others < kObservationsToDiffer) return;
    watched = {};
  }
  watched.others = 0;
  if (watched.observations == 0) {
    watched.first_direction = observation.direction;
    watched.first_frame = frame_;
  }
  ++watched.observations;
  const float step = 1 / std::min(static_cast<float>(watched.observations), kObservationMemory);
  watched.outline += step * (observation.outline - watched.outline);
  watched.hidden += step * (observation.hidden - watched.hidden);
  watched.size_m += step * (size_m - watched.size_m);
  const float cosine = std::clamp(watched.first_direction.dot(observation.direction), -1.0F, 1.0F);
  watched.widest_angle_rad = std::max(watched.widest_angle_rad, std::acos(cosine));
  watched.last_frame = frame_;
}

void ObservationHistory::joinRegions(RegionId into, RegionId from) {
  std::vector<std::pair<RegionSet, Watched>> changed;
  for (auto entry = watched_.begin(); entry != watched_.end();) {
    if (!entry->first.contains(from)) {
      ++entry;
      continue;
    }
    changed.emplace_back(*entry);
    changed.back().first.join(into, from);
    entry = watched_.erase(entry);
  }
  for (const auto& [regions, watched] : changed) {
    Watched& there = watched_[regions];
    if (there.observations < watched.observations) there = watched;
  }
}

bool ObservationHistory::isComplete(const RegionSet& regions, const DiscoveryParams& params) const {
  const auto found = watched_.find(regions);
  if (found == watched_.end()) return false;
  const Watched& watched = found->second;
  constexpr float kRadians = std::numbers::pi_v<float> / 180;
  const bool from_two_sides = watched.widest_angle_rad >= params.complete_angle_deg * kRadians;
  const bool for_long = watched.last_frame - watched.first_frame >= params.still_frames;
  return watched.observations >= params.complete_observations && watched.outline >= params.complete_outline &&
         watched.hidden <= params.complete_hidden && (from_two_sides || for_long);
}

}  // namespace scantrove
