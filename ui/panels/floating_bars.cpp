#include "ui/panels/floating_bars.h"

#include <QEvent>
#include <QRect>

#include "core/base/check.h"

namespace scantrove {

FloatingBars::FloatingBars(QWidget& under) : QObject(&under), under_(under) {
  SCANTROVE_CHECK(under.parentWidget() != nullptr);
  under_.installEventFilter(this);
}

void FloatingBars::add(QWidget& bar) {
  const bool is_hidden = bar.isHidden();
  if (bar.parentWidget() != under_.parentWidget()) bar.setParent(under_.parentWidget());
  bar.setAutoFillBackground(true);
  bar.setVisible(!is_hidden);
  bar.installEventFilter(this);
  bars_.emplace_back(&bar);
  arrange();
}

bool FloatingBars::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Move:
    case QEvent::Resize:
      if (watched == &under_) arrange();
      break;
    case QEvent::ShowToParent:
    case QEvent::HideToParent:
    case QEvent::LayoutRequest:
      if (watched != &under_) arrange();
      break;
    default:
      break;
  }
  return false;
}

void FloatingBars::arrange() {
  QRect free = under_.geometry();
  for (auto place = bars_.rbegin(); place != bars_.rend(); ++place) {
    QWidget* const bar = *place;
    if (bar == nullptr || bar->isHidden()) continue;
    const int height =
        bar->hasHeightForWidth() ? bar->heightForWidth(free.width()) : bar->sizeHint().height();
    bar->setGeometry(free.left(), free.bottom() + 1 - height, free.width(), height);
    bar->raise();
    free.setBottom(bar->y() - 1);
  }
}

}  // namespace scantrove
