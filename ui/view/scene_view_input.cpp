// What the mouse and the keys do in the 3D view.
#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/view/scene_view.h"

namespace scantrove {
namespace {

constexpr float kTurnPerPixel_rad = 0.006F;

}  // namespace

QRectF SceneView::band() const {
  return press_ && band_to_ ? QRectF(*press_, *band_to_).normalized() & QRectF(rect()) : QRectF();
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  last_mouse_ = event->globalPosition();
  press_ = event->position();
  is_dragged_ = false;
  is_given_up_ = false;
  setFocus(Qt::MouseFocusReason);
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) {
    notePointing();
    emit pointedAt(event->position());
    return;
  }
  if (press_ && !is_dragged_) {
    if ((event->position() - *press_).manhattanLength() < QApplication::startDragDistance()) return;
    is_dragged_ = true;
    emit pointerLeft();
    beginStroke(*event);
  }
  if (is_given_up_) return;
  if (!stroke_.isEmpty()) return drawStroke(event->position());
  // On the screen: a message that appears above the view moves the view under the mouse.
  const QPointF step = event->globalPosition() - last_mouse_;
  last_mouse_ = event->globalPosition();
  if (event->buttons().testFlag(Qt::LeftButton) && event->modifiers().testFlag(Qt::ControlModifier)) {
    band_to_ = event->position();
    emit bandChanged();
    return;
  }
  const auto dx = static_cast<float>(step.x());
  const auto dy = static_cast<float>(step.y());
  const auto tall = static_cast<float>(std::max(1, height()));
  const bool shifted = event->modifiers().testFlag(Qt::ShiftModifier);
  if (event->buttons().testFlag(Qt::MiddleButton) || (event->buttons().testFlag(Qt::LeftButton) && shifted)) {
    scene_.viewpoint().pan(-dx / tall, dy / tall);
  } else if (event->buttons().testFlag(Qt::LeftButton)) {
    scene_.viewpoint().orbit(-dx * kTurnPerPixel_rad, dy * kTurnPerPixel_rad);
  } else if (event->buttons().testFlag(Qt::RightButton)) {
    scene_.viewpoint().zoom(std::exp(dy * 0.006F));
  } else {
    return;
  }
  interacted();
}

void SceneView::setDrawsStrokes(bool draws) {
  draws_strokes_ = draws;
  if (stroke_.isEmpty() || draws) return;
  stroke_.clear();
  is_given_up_ = true;
  emit strokeChanged();
}

void SceneView::beginStroke(const QMouseEvent& event) {
  const bool may =
      draws_strokes_ && event.buttons() == Qt::LeftButton && !event.modifiers().testFlag(Qt::ControlModifier);
  if (!may || !at(*press_).region) return;
  setFollowing(false);  // or the scene moves away under the hand
  stroke_.begin(*press_);
  emit strokeAt(at(*press_));
}

void SceneView::drawStroke(const QPointF& to) {
  for (const QPointF& place : stroke_.extend(to)) {
    emit strokeAt(at(place));
    if (stroke_.isEmpty()) return;  // who listens gave it up
  }
  notePointing();
  emit strokeChanged();
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  const QRectF drawn_band = band();
  const bool was_pressed = std::exchange(press_, std::nullopt).has_value();
  if (!stroke_.isEmpty()) {
    drawStroke(event->position());
    stroke_.clear();
    emit strokeChanged();
    emit strokeEnded(event->modifiers());
  } else if (std::exchange(band_to_, std::nullopt)) {
    emit bandChanged();
    emit bandDrawn(drawn_band);
  } else if (was_pressed && !is_dragged_ && event->button() == Qt::LeftButton) {
    emit clicked(event->position(), event->modifiers());
  } else if (was_pressed && !is_dragged_ && event->button() == Qt::RightButton) {
    emit menuRequested(event->position(), event->globalPosition().toPoint());
  }
  is_dragged_ = false;
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  press_.reset();  // its release is no click
  if (event->button() == Qt::LeftButton) emit doubleClicked(event->position());
}

void SceneView::leaveEvent(QEvent* /*event*/) { emit pointerLeft(); }

void SceneView::wheelEvent(QWheelEvent* event) {
  scene_.viewpoint().zoom(std::exp(-static_cast<float>(event->angleDelta().y()) / 120.0F * 0.14F));
  interacted();
  event->accept();
}

void SceneView::keyPressEvent(QKeyEvent* event) {
  constexpr float kStep_rad = 0.10F;
  OrbitCamera& viewpoint = scene_.viewpoint();
  const bool shifted = event->modifiers().testFlag(Qt::ShiftModifier);
  switch (event->key()) {
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
      fitAll();
      return;
    default:
      QWidget::keyPressEvent(event);
      return;
  }
  interacted();
}

}  // namespace scantrove
