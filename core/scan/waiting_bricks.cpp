#include "core/scan/waiting_bricks.h"

#include <algorithm>

namespace scantrove {
namespace {

/// Frames until the next turn of a brick, by the number of its displays.
int waitAfter(std::uint8_t times_shown) {
  int wait = 1;
  while (--times_shown > 0 && wait < WaitingBricks::kLongestWait) wait *= 2;
  return std::min(wait, WaitingBricks::kLongestWait);
}

}  // namespace

void WaitingBricks::add(std::span<const Eigen::Vector3i> bricks) {
  for (const Eigen::Vector3i& brick : bricks) {
    State& state = states_[brick];
    if (state.waits) continue;
    state.waits = true;
    by_turn_[state.turn].push_back(brick);
  }
}

void WaitingBricks::addByPerson(std::span<const Eigen::Vector3i> bricks) {
  for (const Eigen::Vector3i& brick : bricks) {
    State& state = states_[brick];
    if (state.waits && state.by_person) continue;
    state.waits = state.by_person = true;
    by_person_.push_back(brick);
  }
}

std::vector<WaitingBricks::Brick> WaitingBricks::take(std::size_t most, int last_turn) {
  std::vector<Brick> taken;
  takeFrom(by_person_, most, taken);
  while (!by_turn_.empty() && by_turn_.begin()->first <= last_turn && taken.size() < most) {
    takeFrom(by_turn_.begin()->second, most, taken);
    if (by_turn_.begin()->second.empty()) by_turn_.erase(by_turn_.begin());
  }
  return taken;
}

void WaitingBricks::takeFrom(std::deque<Eigen::Vector3i>& from, std::size_t most, std::vector<Brick>& taken) {
  while (!from.empty() && taken.size() < most) {
    const Eigen::Vector3i brick = from.front();
    from.pop_front();
    State& state = states_[brick];
    if (!state.waits) continue;
    taken.push_back({brick, state.by_person});
    state.waits = state.by_person = false;
    state.times_shown = static_cast<std::uint8_t>(std::min(state.times_shown + 1, 255));
    state.turn = frame_ + waitAfter(state.times_shown);
  }
}

}  // namespace scantrove
