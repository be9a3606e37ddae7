#pragma once
#include <QRect>

class QWidget;

namespace scantrove {

/// `requested`, shrunk and moved as little as needed to fit into `room`.
[[nodiscard]] QRect fittedTo(const QRect& requested, const QRect& room);

/// Fits a window that is not shown yet, with its title bar, into the free part of its screen.
void fitToScreen(QWidget& window);

}  // namespace scantrove
