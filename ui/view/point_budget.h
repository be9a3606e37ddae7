#pragma once
#include <algorithm>
#include <cstddef>

namespace scantrove {

/// Number of points so that a drawing takes about `target_ms`, adjusted after each drawing. At least
/// `min_points`: fewer hardly save time (the picture must still be cleared and copied) and shapes become
/// unrecognisable, so slow scenes are drawn less often instead. At max_points `max_points`: hidden points are
/// fast to draw and would raise the budget too far.
class PointBudget {
 public:
  static constexpr double kMax = 4e6;

  PointBudget(double target_ms, double min_points, double first, double max_points = kMax)
      : target_ms_(target_ms), min_points_(min_points), max_points_(max_points), points_(first) {}

  [[nodiscard]] std::size_t points() const { return static_cast<std::size_t>(points_); }

  /// Adjusts the budget: drawing `drawn` points took `ms`.
  void update(std::size_t drawn, double ms) {
    // A fast drawing of a small scene must not raise the budget.
    const bool full = 2 * static_cast<double>(drawn) > points_;
    if (!full && ms < target_ms_) return;
    points_ =
        std::clamp(points_ * std::clamp(target_ms_ / std::max(ms, 0.1), 0.7, 1.4), min_points_, max_points_);
  }

 private:
  double target_ms_;
  double min_points_;
  double max_points_;
  double points_;
};

}  // namespace scantrove
