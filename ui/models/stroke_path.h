#pragma once
#include <QPolygonF>
#include <cmath>

namespace scantrove {

/// What a person draws with the button held down, in pixels of the widget (logical ones, whatever the
/// screen's resolution). A quick hand moves many pixels between two events: the way between is filled in.
class StrokePath {
 public:
  static constexpr double kStep_px = 3;  ///< of neighbouring places at most

  void begin(const QPointF& at) { places_ = QPolygonF({at}); }
  void clear() { places_.clear(); }
  [[nodiscard]] bool isEmpty() const { return places_.isEmpty(); }
  [[nodiscard]] const QPolygonF& places() const { return places_; }

  /// Draws on to `at`. Result: the places that are new, `at` last; none where the pointer did not move.
  QPolygonF extend(const QPointF& at) {
    const QPointF from = places_.last();
    const QPointF way = at - from;
    const int steps = static_cast<int>(std::ceil(std::hypot(way.x(), way.y()) / kStep_px));
    QPolygonF added;
    for (int i = 1; i <= steps; ++i) added << from + way * (static_cast<double>(i) / steps);
    places_ += added;
    return added;
  }

 private:
  QPolygonF places_;
};

}  // namespace scantrove
