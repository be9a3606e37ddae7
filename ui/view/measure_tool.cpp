#include "ui/view/measure_tool.h"

#include <QKeyEvent>
#include <QLocale>
#include <QMouseEvent>
#include <algorithm>

#include "ui/view/scene_view.h"
#include "ui/view/view_label.h"

namespace scantrove {
namespace {
constexpr double kDrag_px = 4;  ///< a longer move is a drag
}

MeasureTool::MeasureTool(SceneView* view)
    : QObject(view), view_(view), hint_(new ViewLabel(view)), length_label_(new ViewLabel(view)) {
  length_label_->setObjectName(QStringLiteral("measuredLength"));
  view->installEventFilter(this);
  connect(view, &SceneView::drawn, this, &MeasureTool::placeLabels, Qt::QueuedConnection);
  connect(view, &SceneView::cleared, this, &MeasureTool::clear);
}

void MeasureTool::setActive(bool active) {
  if (active == active_) return;
  active_ = active;
  hint_->setVisible(false);
  if (active) {
    view_->setMouseTracking(true);
    view_->setFocus(Qt::OtherFocusReason);
  }
  clear();
}

void MeasureTool::clear() {
  ends_.clear();
  under_mouse_.reset();
  pressed_at_.reset();
  length_label_->setVisible(false);
  showLine();
}

std::optional<float> MeasureTool::length() const {
  if (ends_.size() < 2) return std::nullopt;
  return (ends_[1] - ends_[0]).norm();
}

QString MeasureTool::lengthText(float meters) {
  const auto length = static_cast<double>(meters);
  const QLocale locale;
  return length < 1 ? tr("%1 cm").arg(locale.toString(100 * length, 'f', 1))
                    : tr("%1 m").arg(locale.toString(length, 'f', 3));
}

bool MeasureTool::eventFilter(QObject* watched, QEvent* event) {
  if (!active_) return QObject::eventFilter(watched, event);
  switch (event->type()) {
    case QEvent::ShortcutOverride:
      // Escape ends the tool, even if it is also a shortcut.
      if (static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape) return false;
      event->accept();
      return true;
    case QEvent::KeyPress:
      if (static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape) return false;
      setActive(false);
      emit ended();
      return true;
    case QEvent::MouseButtonPress:
      return press(*static_cast<QMouseEvent*>(event));
    case QEvent::MouseButtonRelease:
      return release(*static_cast<QMouseEvent*>(event));
    case QEvent::MouseButtonDblClick:
      press(*static_cast<QMouseEvent*>(event));
      return true;  // the view must not handle it
    case QEvent::MouseMove:
      if (static_cast<QMouseEvent*>(event)->buttons() == Qt::NoButton)
        hover(static_cast<QMouseEvent*>(event)->position());
      return false;
    default:
      return QObject::eventFilter(watched, event);
  }
}

bool MeasureTool::press(const QMouseEvent& event) {
  if (event.button() == Qt::LeftButton) pressed_at_ = event.position();
  return false;  // it may become a drag
}

bool MeasureTool::release(const QMouseEvent& event) {
  if (event.button() != Qt::LeftButton || !pressed_at_) return false;
  const QPointF distance = event.position() - *pressed_at_;
  pressed_at_.reset();
  if (distance.manhattanLength() > kDrag_px) return false;
  if (const std::optional<Eigen::Vector3f> end = surfaceAt(event.position())) {
    if (ends_.size() > 1) ends_.clear();
    ends_.push_back(*end);
    under_mouse_.reset();
    showLine();
  }
  return true;
}

void MeasureTool::hover(const QPointF& at) {
  if (ends_.size() != 1) return;
  under_mouse_ = surfaceAt(at);
  showLine();
}

std::optional<Eigen::Vector3f> MeasureTool::surfaceAt(const QPointF& at) const {
  const auto x = static_cast<float>(2 * at.x() / view_->width() - 1);
  const auto y = static_cast<float>(1 - 2 * at.y() / view_->height());
  return view_->scene().pick(x, y, view_->width(), view_->height());
}

void MeasureTool::showLine() {
  std::vector<Eigen::Vector3f> line = ends_;
  if (under_mouse_) line.push_back(*under_mouse_);
  view_->scene().showMeasure(line);
  placeLabels();
  view_->drawing().redraw();
}

void MeasureTool::placeLabels() {
  if (!active_) return;
  hint_->showBelow(ends_.size() == 1 ? tr("Measure — click the other end; Escape ends")
                                     : tr("Measure — click one end; Escape ends"),
                   1);
  std::vector<Eigen::Vector3f> line = ends_;
  if (under_mouse_) line.push_back(*under_mouse_);
  const float aspect = static_cast<float>(view_->width()) / static_cast<float>(std::max(1, view_->height()));
  std::optional<Eigen::Vector2f> place;
  if (line.size() > 1) place = view_->scene().viewpoint().positionOf((line[0] + line[1]) / 2, aspect);
  if (!place || place->cwiseAbs().maxCoeff() > 1) return length_label_->hide();
  const QPointF middle((1 + static_cast<double>(place->x())) * view_->width() / 2,
                       (1 - static_cast<double>(place->y())) * view_->height() / 2);
  length_label_->showAt(lengthText((line[1] - line[0]).norm()), middle - QPointF(0, 22));
}

}  // namespace scantrove
