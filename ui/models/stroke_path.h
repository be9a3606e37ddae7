#pragma once
#include <QPolygonF>
#include <cmath>

namespace scantrove {

/// A stroke that the user draws with the button held down, in logical pixels of the widget. Fills the gaps
/// between mouse events.
class StrokePath {
 public:
  static constexpr double kStep_px = 3;  ///< largest distance of neighbouring points

  void begin(const QPointF& at) { points_ = QPolygonF({at}); }
  void clear() { points_.clear(); }
  [[nodiscard]] bool isEmpty() const { return points_.isEmpty(); }
  [[nodiscard]] const QPolygonF& points() const { return points_; }

  /// Continues the stroke to `at`. Result: the new points, `at` last; empty if the pointer did not move.
  QPolygonF extend(const QPointF& at) {
    const QPointF from = points_.last();
    const QPointF way = at - from;
    const int steps = static_cast<int>(std::ceil(std::hypot(way.x(), way.y()) / kStep_px));
    QPolygonF added;
    for (int i = 1; i <= steps; ++i) added << from + way * (static_cast<double>(i) / steps);
    points_ += added;
    return added;
  }

 private:
  QPolygonF points_;
};

}  // namespace scantrove
