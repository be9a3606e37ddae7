#pragma once
#include <QRect>

class QWidget;

namespace scantrove {

/// `wanted`, made smaller and moved only as far as it has to be to lie in `room`.
[[nodiscard]] QRect fittedTo(const QRect& requested, const QRect& room);

/// Brings a window that is not shown yet into the free part of its screen, with its title bar.
void fitToScreen(QWidget& window);

}  // namespace scantrove
