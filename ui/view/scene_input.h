#pragma once
#include <QObject>
#include <QPointF>
#include <QPolygonF>
#include <QRectF>
#include <optional>

#include "ui/models/stroke_path.h"

class QKeyEvent;
class QMouseEvent;
class QWheelEvent;

namespace scantrove {

class SceneView;

/// What the mouse and the keys do in the 3D view. Left drag turns, middle or Shift+left drag moves, right
/// drag or wheel zooms, Ctrl+left drag draws a band; arrow keys, + and - and Home do the same from the
/// keyboard. What is pointed at, clicked and drawn is told by the view's signals.
class SceneInput : public QObject {
 public:
  /// `view` outlives it.
  explicit SceneInput(SceneView& view);

  /// While on, a left drag that begins on a region draws a stroke, and SceneView::strokeAt() says what lies
  /// under it; one that begins beside everything turns the view as ever. Turned off, a stroke on its way is
  /// given up.
  void setDrawsStrokes(bool draws);
  /// What is being drawn, widget coordinates; empty: nothing is.
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.places(); }
  /// Of the band that is being drawn, widget coordinates; empty: none is.
  [[nodiscard]] QRectF band() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void press(const QMouseEvent& event);
  void move(const QMouseEvent& event);
  void release(const QMouseEvent& event);
  void zoom(QWheelEvent& event);
  /// False: the key does nothing here.
  bool pressKey(const QKeyEvent& event);
  void beginStroke(const QMouseEvent& event);
  void drawStroke(const QPointF& to);
  /// A person has changed the viewpoint.
  void interacted();

  SceneView& view_;
  QPointF last_mouse_;                      ///< on the screen
  std::optional<QPointF> press_, band_to_;  ///< in the widget
  bool is_dragged_ = false;                 ///< since the press
  bool is_given_up_ = false;                ///< the stroke of this press: the rest of the drag does nothing
  bool draws_strokes_ = false;
  StrokePath stroke_;
};

}  // namespace scantrove
