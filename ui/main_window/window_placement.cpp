#include "ui/main_window/window_placement.h"

#include <QScreen>
#include <QStyle>
#include <QWidget>
#include <algorithm>

namespace scantrove {

QRect fittedTo(const QRect& requested, const QRect& room) {
  const QSize size = requested.size().boundedTo(room.size());
  const int x = std::clamp(requested.x(), room.x(), room.x() + room.width() - size.width());
  const int y = std::clamp(requested.y(), room.y(), room.y() + room.height() - size.height());
  return {QPoint(x, y), size};
}

void fitToScreen(QWidget& window) {
  if (window.isMaximized() || window.isFullScreen()) return;
  // The frame is not known before the window is shown.
  const int title_bar = window.style()->pixelMetric(QStyle::PM_TitleBarHeight);
  const QRect room = window.screen()->availableGeometry().adjusted(0, title_bar, 0, 0);
  const QRect fitted = fittedTo(window.geometry(), room);
  if (fitted.size() != window.size()) window.resize(fitted.size());
  // A window that was never moved is placed by the desktop.
  if (window.testAttribute(Qt::WA_Moved) && fitted.topLeft() != window.pos()) window.move(fitted.topLeft());
}

}  // namespace scantrove
