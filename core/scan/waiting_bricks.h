#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/fusion/brick_index.h"

namespace scantrove {

/// Changed bricks in the order of display: first those that a user changed, then those never shown, then
/// those whose turn comes first. Bricks in view change in every frame but hardly differ: after each display
/// of a brick, about twice as many frames pass until its next turn.
class WaitingBricks {
 public:
  /// Maximum number of frames between two turns: bounds the delay of a visible change.
  static constexpr int kLongestWait = 24;

  struct Brick {
    Eigen::Vector3i position;  ///< in units of bricks, because slots are reused
    bool by_person = false;
  };

  void beginFrame() { ++frame_; }
  void add(std::span<const Eigen::Vector3i> bricks);
  /// A user changed these, and waits to see them.
  void addByPerson(std::span<const Eigen::Vector3i> bricks);

  /// Takes at most so many of those that are due, in order.
  [[nodiscard]] std::vector<Brick> takeDue(std::size_t most) { return take(most, frame_); }
  /// Takes all, due or not.
  [[nodiscard]] std::vector<Brick> takeAny(std::size_t most) {
    return take(most, std::numeric_limits<int>::max());
  }

 private:
  struct State {
    int turn = 0;  ///< the frame from which on it is due
    std::uint8_t times_shown = 0;
    bool waits = false;
    bool by_person = false;
  };

  [[nodiscard]] std::vector<Brick> take(std::size_t most, int last_turn);
  /// Appends those of `from` that still wait, up to `most`.
  void takeFrom(std::deque<Eigen::Vector3i>& from, std::size_t most, std::vector<Brick>& taken);

  int frame_ = 0;
  std::unordered_map<Eigen::Vector3i, State, BrickHash> states_;
  std::deque<Eigen::Vector3i> by_person_;
  std::map<int, std::deque<Eigen::Vector3i>> by_turn_;  ///< some were taken meanwhile: State::waits tells
};

}  // namespace scantrove
