#include "ui/view/clip_tool.h"

#include <QKeyEvent>
#include <QLocale>
#include <QWheelEvent>
#include <algorithm>

#include "ui/view/scene_view.h"
#include "ui/view/view_label.h"

namespace scantrove {

ClipTool::ClipTool(SceneView* view) : QObject(view), view_(view), label_(new ViewLabel(view)) {
  view->installEventFilter(this);
  connect(view, &SceneView::drawn, this, &ClipTool::showLabel, Qt::QueuedConnection);
}

void ClipTool::setActive(bool active) {
  if (active == active_) return;
  active_ = active;
  behind_target_m_ = 0;
  label_->setVisible(false);
  active ? view_->scene().setClipDistance(behind_target_m_) : view_->scene().setClipDistance(std::nullopt);
  showLabel();
  view_->drawing().redraw();
}

void ClipTool::move(float steps) {
  const OrbitCamera& viewpoint = view_->scene().viewpoint();
  behind_target_m_ = std::max(behind_target_m_ + 0.04F * steps * viewpoint.distance(), -viewpoint.distance());
  view_->scene().setClipDistance(behind_target_m_);
  showLabel();
  view_->drawing().redraw(true);
}

void ClipTool::showLabel() {
  if (!active_) return;
  const float distance_m = view_->scene().clipDistance().value_or(0);
  label_->showBelow(tr("Clip plane at %1 m — Ctrl + wheel moves it, X removes it")
                        .arg(QLocale().toString(static_cast<double>(distance_m), 'f', 2)),
                    0);
}

bool ClipTool::eventFilter(QObject* watched, QEvent* event) {
  if (!active_) return QObject::eventFilter(watched, event);
  if (event->type() == QEvent::Wheel) {
    const auto* wheel = static_cast<QWheelEvent*>(event);
    if (!wheel->modifiers().testFlag(Qt::ControlModifier)) return false;
    move(static_cast<float>(wheel->angleDelta().y()) / 120.0F);
    return true;
  }
  if (event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool moves = key->key() == Qt::Key_Up || key->key() == Qt::Key_Down;
    if (!moves || !key->modifiers().testFlag(Qt::ControlModifier)) return false;
    move(key->key() == Qt::Key_Up ? 1 : -1);
    return true;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace scantrove
