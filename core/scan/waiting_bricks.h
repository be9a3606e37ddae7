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

/// Bricks that changed, and whose turn it is to be shown: first those that a person changed, then those that
/// were never shown, then those whose turn comes first. What is filmed for long changes in every frame and
/// hardly looks different: each time a brick is shown, about twice as many frames pass until its next turn.
class WaitingBricks {
 public:
  /// Frames between two turns at most: how late something that became different late is seen.
  static constexpr int kLongestWait = 24;

  struct Brick {
    Eigen::Vector3i position;  ///< in units of bricks: slots change hands
    bool by_person = false;
  };

  void beginFrame() { ++frame_; }
  void add(std::span<const Eigen::Vector3i> bricks);
  /// A person changed these, and waits for it to be seen.
  void addByPerson(std::span<const Eigen::Vector3i> bricks);

  /// In order, at most so many of those whose turn it is; they wait no longer.
  [[nodiscard]] std::vector<Brick> takeDue(std::size_t most) { return take(most, frame_); }
  /// The same of all, whenever their turn is.
  [[nodiscard]] std::vector<Brick> takeAny(std::size_t most) {
    return take(most, std::numeric_limits<int>::max());
  }

 private:
  struct State {
    int turn = 0;  ///< the frame from which on it is shown
    std::uint8_t times_shown = 0;
    bool waits = false;
    bool by_person = false;
  };

  [[nodiscard]] std::vector<Brick> take(std::size_t most, int last_turn);
  /// Appends those of `from` that still wait, until there are `most`.
  void takeFrom(std::deque<Eigen::Vector3i>& from, std::size_t most, std::vector<Brick>& taken);

  int frame_ = 0;
  std::unordered_map<Eigen::Vector3i, State, BrickHash> states_;
  std::deque<Eigen::Vector3i> by_person_;
  std::map<int, std::deque<Eigen::Vector3i>> by_turn_;  ///< some were taken meanwhile: State::waits says so
};

}  // namespace scantrove
