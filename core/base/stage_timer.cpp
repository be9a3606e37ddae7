#include "core/base/stage_timer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace scantrove {

DurationSummary summarize(std::vector<double> durations_ms) {
  if (durations_ms.empty()) return {};
  std::sort(durations_ms.begin(), durations_ms.end());
  const auto at = [&](double fraction) {
    const double rank = std::ceil(fraction * static_cast<double>(durations_ms.size()));
    return durations_ms[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  return {at(0.5), at(0.95)};
}

std::size_t StageTimer::indexOf(std::string_view name) {
  const auto found =
      std::find_if(stages_.begin(), stages_.end(), [&](const Stage& s) { return s.name == name; });
  if (found != stages_.end()) return static_cast<std::size_t>(found - stages_.begin());
  stages_.emplace_back().name = name;
  return stages_.size() - 1;
}

void StageTimer::add(std::string_view name, double duration_ms) {
  const std::size_t stage = indexOf(name);
  const auto found =
      std::find_if(pending_.begin(), pending_.end(), [&](const Pending& p) { return p.stage == stage; });
  if (found != pending_.end()) {
    found->duration_ms += duration_ms;
  } else {
    pending_.push_back({stage, duration_ms});
  }
}

void StageTimer::Stage::thinOut() {
  for (std::size_t i = 0; 2 * i < all_ms.size(); ++i) {
    all_ms[i] = all_ms[2 * i];
    frames[i] = frames[2 * i];
  }
  all_ms.resize((all_ms.size() + 1) / 2);
  frames.resize(all_ms.size());
  every *= 2;
}

void StageTimer::endFrame() {
  for (const Pending& pending : pending_) {
    Stage& stage = stages_[pending.stage];
    stage.last_ms = pending.duration_ms;
    if (stage.all_ms.size() >= kMaxFrames) stage.thinOut();
    if (stage.runs++ % stage.every != 0) continue;
    stage.all_ms.push_back(pending.duration_ms);
    stage.frames.push_back(frames_);
  }
  pending_.clear();
  ++frames_;
}

std::vector<SlowFrame> slowestFrames(const std::vector<StageTimer::Stage>& stages, std::size_t most) {
  std::map<std::size_t, SlowFrame> by_frame;
  std::map<std::size_t, double> above_median_ms;
  for (const StageTimer::Stage& stage : stages) {
    const double median_ms = summarize(stage.all_ms).median_ms;
    for (std::size_t i = 0; i < stage.all_ms.size(); ++i) {
      SlowFrame& slow = by_frame[stage.frames[i]];
      slow.frame = stage.frames[i];
      slow.total_ms += stage.all_ms[i];
      const double above_ms = stage.all_ms[i] - median_ms;
      if (!slow.stage.empty() && above_ms <= above_median_ms[slow.frame]) continue;
      above_median_ms[slow.frame] = above_ms;
      slow.stage = stage.name;
      slow.stage_ms = stage.all_ms[i];
    }
  }
  std::vector<SlowFrame> slowest;
  for (auto& [frame, slow] : by_frame) slowest.push_back(std::move(slow));
  std::ranges::stable_sort(slowest, std::greater{}, &SlowFrame::total_ms);
  if (slowest.size() > most) slowest.resize(most);
  return slowest;
}

}  // namespace scantrove
