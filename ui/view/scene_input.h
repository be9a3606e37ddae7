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

/// Mouse and keyboard input of the 3D view. Left drag turns, middle or Shift+left drag moves, right drag or
/// wheel zooms, Ctrl+left drag draws a selection band. Arrow keys, +, - and Home do the same. Emits the
/// view's signals for pointing, clicks and drags.
class SceneInput : public QObject {
 public:
  /// `view` outlives it.
  explicit SceneInput(SceneView& view);

  /// While on, a left drag that begins on a region draws a stroke and emits SceneView::strokeAt(); other
  /// drags turn the view. Turning it off cancels the current stroke.
  void setDrawsStrokes(bool draws);
  /// The current stroke in widget coordinates; empty: none.
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.points(); }
  /// The current selection band in widget coordinates; empty: none.
  [[nodiscard]] QRectF band() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void press(const QMouseEvent& event);
  void move(const QMouseEvent& event);
  void release(const QMouseEvent& event);
  void zoom(QWheelEvent& event);
  /// False if the key has no function here.
  bool pressKey(const QKeyEvent& event);
  void beginStroke(const QMouseEvent& event);
  /// Clears it; the view follows the camera again if it did before.
  void endStroke();
  void drawStroke(const QPointF& to);
  /// Handles a change of the viewpoint by the user.
  void interacted();

  SceneView& view_;
  QPointF last_mouse_;                      ///< on the screen
  std::optional<QPointF> press_, band_to_;  ///< in the widget
  bool is_dragged_ = false;                 ///< since the press
  bool is_cancelled_ = false;               ///< the stroke was cancelled; the rest of the drag does nothing
  bool draws_strokes_ = false;
  StrokePath stroke_;
  bool follows_again_ = false;  // the view followed the camera before the stroke
};

}  // namespace scantrove
