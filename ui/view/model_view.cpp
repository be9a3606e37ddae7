#include "ui/view/model_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/view/qt_render_window.h"

namespace scantrove {
namespace {

constexpr int kFrame_ms = 50;
constexpr float kTurnOfAFrame = 0.022F;  ///< radians: a turn takes a quarter of a minute
constexpr float kTurnOfAKey = 0.15F;
constexpr float kTurnOfAPixel = 0.01F;
constexpr float kZoomOfAKey = 0.85F;

}  // namespace

ModelView::ModelView(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(200, 160);
  setAccessibleName(tr("3D model"));
  setAccessibleDescription(
      tr("The object as coloured points. Arrow keys turn, plus and minus zoom, Home shows all, Space starts "
         "and stops the turning."));
  setToolTip(tr("Drag or arrow keys turn the model, the wheel zooms, Space starts and stops the turning."));
  timer_.setInterval(kFrame_ms);
  connect(&timer_, &QTimer::timeout, this, [this] {
    scene_.viewpoint().orbit(kTurnOfAFrame, 0);
    redraw();
  });
}

ModelView::~ModelView() {
  // VTK must free its OpenGL objects while the context exists.
  if (window_ != nullptr) window_->makeCurrent();
  scene_.clear();
}

void ModelView::setModel(std::span<const ViewPoint> points, float spacing_m, const Eigen::Vector3f& up,
                         bool is_same) {
  if (window_ != nullptr) window_->makeCurrent();
  scene_.setPoints(points, spacing_m, up);
  if (!is_same) {
    is_turning_ = true;
    fit();
  }
  updateTimer();
  redraw();
}

void ModelView::setColors(const Rgb& top, const Rgb& bottom) {
  scene_.setBackground(top, bottom);
  redraw();
}

void ModelView::setTurning(bool turning) {
  is_turning_ = turning;
  updateTimer();
}

void ModelView::updateTimer() {
  const bool runs = is_turning_ && isVisible() && scene_.pointCount() > 0;
  if (runs != timer_.isActive()) runs ? timer_.start() : timer_.stop();
}

void ModelView::fit() { scene_.fit(static_cast<float>(width()) / static_cast<float>(std::max(1, height()))); }

void ModelView::redraw() {
  picture_ = {};
  update();
}

void ModelView::paintEvent(QPaintEvent* /*event*/) {
  const QSize pixels = size() * devicePixelRatioF();
  if (picture_.isNull() && !pixels.isEmpty()) {
    if (window_ == nullptr) window_ = std::make_unique<QtRenderWindow>(scene_.renderer());
    scene_.prepare(pixels.width(), pixels.height());
    window_->draw(pixels);
    picture_ = window_->picture(pixels);
  }
  QPainter painter(this);
  if (!picture_.isNull()) return painter.drawImage(rect(), picture_);
  painter.fillRect(rect(), palette().window());
  painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, tr("This display has no OpenGL 3.2."));
}

void ModelView::resizeEvent(QResizeEvent* /*event*/) { redraw(); }

void ModelView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  fit();
  updateTimer();
}

void ModelView::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  updateTimer();
}

void ModelView::turnByHand(float yaw, float pitch) {
  setTurning(false);
  scene_.viewpoint().orbit(yaw, pitch);
  redraw();
}

void ModelView::zoom(float factor) {
  scene_.viewpoint().zoom(factor);
  redraw();
}

void ModelView::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return turnByHand(kTurnOfAKey, 0);
    case Qt::Key_Right:
      return turnByHand(-kTurnOfAKey, 0);
    case Qt::Key_Up:
      return turnByHand(0, kTurnOfAKey);
    case Qt::Key_Down:
      return turnByHand(0, -kTurnOfAKey);
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoom(kZoomOfAKey);
    case Qt::Key_Minus:
      return zoom(1 / kZoomOfAKey);
    case Qt::Key_Home:
      fit();
      return redraw();
    case Qt::Key_Space:
      return setTurning(!is_turning_);
    default:
      QWidget::keyPressEvent(event);
  }
}

void ModelView::mousePressEvent(QMouseEvent* event) {
  dragged_from_ = event->position().toPoint();
  setTurning(false);
}

void ModelView::mouseMoveEvent(QMouseEvent* event) {
  if (!event->buttons().testFlag(Qt::LeftButton)) return;
  const QPoint moved = event->position().toPoint() - dragged_from_;
  dragged_from_ = event->position().toPoint();
  turnByHand(-kTurnOfAPixel * static_cast<float>(moved.x()), kTurnOfAPixel * static_cast<float>(moved.y()));
}

void ModelView::wheelEvent(QWheelEvent* event) {
  zoom(std::pow(kZoomOfAKey, static_cast<float>(event->angleDelta().y()) / 120));
  event->accept();
}

}  // namespace scantrove
