#include "ui/view/view_label.h"

#include <algorithm>

namespace scantrove {

ViewLabel::ViewLabel(QWidget* parent) : QLabel(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setStyleSheet(
      QStringLiteral("QLabel { background: rgba(18, 20, 24, 215); color: #f2f4f7; border-radius: 6px;"
                     " padding: 4px 9px; }"));
  hide();
}

void ViewLabel::showAt(const QString& text, const QPointF& middle) {
  if (text != this->text()) {
    setText(text);
    adjustSize();
  }
  const QSize room = parentWidget()->size();
  const QPoint corner = (middle - QPointF(width(), height()) / 2).toPoint();
  move(std::clamp(corner.x(), 4, std::max(4, room.width() - width() - 4)),
       std::clamp(corner.y(), 4, std::max(4, room.height() - height() - 4)));
  if (!isHidden()) return;
  show();
  raise();
}

void ViewLabel::showBelow(const QString& text, int row) {
  const QWidget* view = parentWidget();
  showAt(text, QPointF(view->width() / 2.0, view->height() - 26 - 34 * row));
}

}  // namespace scantrove
