#include "ui/view/scene_input.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/view/scene_view.h"

namespace scantrove {
namespace {

constexpr float kTurnPerPixel_rad = 0.006F;

}  // namespace

SceneInput::SceneInput(SceneView& view) : view_(view) { view.installEventFilter(this); }

bool SceneInput::eventFilter(QObject* /*watched*/, QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      press(static_cast<const QMouseEvent&>(*event));
      return true;
    case QEvent::MouseMove:
      move(static_cast<const QMouseEvent&>(*event));
      return true;
    case QEvent::MouseButtonRelease:
      release(static_cast<const QMouseEvent&>(*event));
      return true;
    case QEvent::MouseButtonDblClick: {
      press_.reset();  // so that its release is no click
      const auto& mouse = static_cast<const QMouseEvent&>(*event);
      if (mouse.button() == Qt::LeftButton) emit view_.doubleClicked(mouse.position());
      return true;
    }
    case QEvent::Leave:
      emit view_.pointerLeft();
      return false;
    case QEvent::Wheel:
      zoom(static_cast<QWheelEvent&>(*event));
      return true;
    case QEvent::KeyPress:
      return pressKey(static_cast<const QKeyEvent&>(*event));
    default:
      return false;
  }
}

void SceneInput::zoom(QWheelEvent& event) {
  view_.scene().viewpoint().zoom(std::exp(-static_cast<float>(event.angleDelta().y()) / 120.0F * 0.14F));
  interacted();
  event.accept();
}

void SceneInput::interacted() {
  if (view_.scene().following()) {
    view_.scene().setFollowing(false);
    emit view_.followingChanged(false);
  }
  view_.drawing().redraw(true);
}

QRectF SceneInput::band() const {
  return press_ && band_to_ ? QRectF(*press_, *band_to_).normalized() & QRectF(view_.rect()) : QRectF();
}

void SceneInput::press(const QMouseEvent& event) {
  last_mouse_ = event.globalPosition();
  press_ = event.position();
  is_dragged_ = false;
  is_cancelled_ = false;
  view_.setFocus(Qt::MouseFocusReason);
}

void SceneInput::move(const QMouseEvent& event) {
  if (event.buttons() == Qt::NoButton) {
    view_.drawing().notePointing();
    emit view_.pointedAt(event.position());
    return;
  }
  if (press_ && !is_dragged_) {
    if ((event.position() - *press_).manhattanLength() < QApplication::startDragDistance()) return;
    is_dragged_ = true;
    emit view_.pointerLeft();
    beginStroke(event);
  }
  if (is_cancelled_) return;
  if (!stroke_.isEmpty()) return drawStroke(event.position());
  // Uses screen coordinates, because a message that appears above the view moves the view.
  const QPointF step = event.globalPosition() - last_mouse_;
  last_mouse_ = event.globalPosition();
  if (event.buttons().testFlag(Qt::LeftButton) && event.modifiers().testFlag(Qt::ControlModifier)) {
    band_to_ = event.position();
    emit view_.bandChanged();
    return;
  }
  const auto dx = static_cast<float>(step.x());
  const auto dy = static_cast<float>(step.y());
  const auto view_height = static_cast<float>(std::max(1, view_.height()));
  const bool shifted = event.modifiers().testFlag(Qt::ShiftModifier);
  if (event.buttons().testFlag(Qt::MiddleButton) || (event.buttons().testFlag(Qt::LeftButton) && shifted)) {
    view_.scene().viewpoint().pan(-dx / view_height, dy / view_height);
  } else if (event.buttons().testFlag(Qt::LeftButton)) {
    view_.scene().viewpoint().orbit(-dx * kTurnPerPixel_rad, dy * kTurnPerPixel_rad);
  } else if (event.buttons().testFlag(Qt::RightButton)) {
    view_.scene().viewpoint().zoom(std::exp(dy * 0.006F));
  } else {
    return;
  }
  interacted();
}

void SceneInput::setDrawsStrokes(bool draws) {
  draws_strokes_ = draws;
  if (stroke_.isEmpty() || draws) return;
  endStroke();
  is_cancelled_ = true;
  emit view_.strokeChanged();
}

void SceneInput::beginStroke(const QMouseEvent& event) {
  const bool draws =
      draws_strokes_ && event.buttons() == Qt::LeftButton && !event.modifiers().testFlag(Qt::ControlModifier);
  if (!draws || !view_.at(*press_).region) return;
  follows_again_ = view_.scene().following();
  view_.setFollowing(false);  // otherwise the scene moves under the pointer
  stroke_.begin(*press_);
  emit view_.strokeAt(view_.at(*press_));
}

void SceneInput::endStroke() {
  stroke_.clear();
  if (std::exchange(follows_again_, false)) view_.setFollowing(true);
}

void SceneInput::drawStroke(const QPointF& to) {
  for (const QPointF& point : stroke_.extend(to)) {
    emit view_.strokeAt(view_.at(point));
    if (stroke_.isEmpty()) return;  // a receiver cancelled it
  }
  view_.drawing().notePointing();
  emit view_.strokeChanged();
}

void SceneInput::release(const QMouseEvent& event) {
  const QRectF drawn_band = band();
  const bool was_pressed = std::exchange(press_, std::nullopt).has_value();
  if (!stroke_.isEmpty()) {
    drawStroke(event.position());
    endStroke();
    emit view_.strokeChanged();
    emit view_.strokeEnded(event.modifiers());
  } else if (std::exchange(band_to_, std::nullopt)) {
    emit view_.bandChanged();
    emit view_.bandDrawn(drawn_band);
  } else if (was_pressed && !is_dragged_ && event.button() == Qt::LeftButton) {
    emit view_.clicked(event.position(), event.modifiers());
  } else if (was_pressed && !is_dragged_ && event.button() == Qt::RightButton) {
    emit view_.menuRequested(event.position(), event.globalPosition().toPoint());
  }
  is_dragged_ = false;
}

bool SceneInput::pressKey(const QKeyEvent& event) {
  constexpr float kStep_rad = 0.10F;
  OrbitCamera& viewpoint = view_.scene().viewpoint();
  const bool shifted = event.modifiers().testFlag(Qt::ShiftModifier);
  switch (event.key()) {
    case Qt::Key_Left:
      shifted ? viewpoint.pan(-0.05F, 0) : viewpoint.orbit(kStep_rad, 0);
      break;
    case Qt::Key_Right:
      shifted ? viewpoint.pan(0.05F, 0) : viewpoint.orbit(-kStep_rad, 0);
      break;
    case Qt::Key_Up:
      shifted ? viewpoint.pan(0, 0.05F) : viewpoint.orbit(0, kStep_rad);
      break;
    case Qt::Key_Down:
      shifted ? viewpoint.pan(0, -0.05F) : viewpoint.orbit(0, -kStep_rad);
      break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      viewpoint.zoom(0.88F);
      break;
    case Qt::Key_Minus:
      viewpoint.zoom(1 / 0.88F);
      break;
    case Qt::Key_Home:
      view_.fitAll();
      return true;
    default:
      return false;
  }
  interacted();
  return true;
}

}  // namespace scantrove
