#pragma once
#include <algorithm>
#include <cstddef>

namespace scantrove {

/// How many points to draw so that one drawing takes about `target_ms`, learnt from the drawings before.
/// Never fewer than `fewest`: below that a drawing hardly gets cheaper (clearing and copying the picture
/// remain) and shapes dissolve; what is too slow even then must be drawn less often. Never more than `most`:
/// points that others hide are quick, and say nothing about those that are seen.
class PointBudget {
 public:
  static constexpr double kMax = 4e6;

  PointBudget(double target_ms, double fewest, double first, double most = kMax)
      : target_ms_(target_ms), fewest_(fewest), most_(most), points_(first) {}

  [[nodiscard]] std::size_t points() const { return static_cast<std::size_t>(points_); }

  /// Drawing `drawn` points took `ms`.
  void learn(std::size_t drawn, double ms) {
    // A small scene is drawn quickly and says nothing about a large one.
    const bool full = 2 * static_cast<double>(drawn) > points_;
    if (!full && ms < target_ms_) return;
    points_ = std::clamp(points_ * std::clamp(target_ms_ / std::max(ms, 0.1), 0.7, 1.4), fewest_, most_);
  }

 private:
  double target_ms_;
  double fewest_;
  double most_;
  double points_;
};

}  // namespace scantrove
