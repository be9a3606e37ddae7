#include "ui/panels/views_strip.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>

#include "ui/theme/theme.h"

namespace scantrove {
namespace {
constexpr int kPictureGap = 6;
constexpr int kMaxHeight = 84, kMinHeight = 40;  ///< of the pictures; smaller in a low window
constexpr int kMargin = 2;
constexpr int kKeyStep = 90;

int widthOf(const QImage& picture, int height) {
  return std::clamp(picture.width() * height / std::max(1, picture.height()), kMinHeight, 160);
}
}  // namespace

ViewsStrip::ViewsStrip(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(kMinHeight + 2 * kMargin);
  setMaximumHeight(kMaxHeight + 2 * kMargin);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Views of the selected object"));
  setToolTip(tr("Views of the selected object, newest first. The wheel or the arrow keys scroll."));
}

void ViewsStrip::setViews(std::vector<QImage> pictures, const QString& note) {
  pictures_ = std::move(pictures);
  note_ = note;
  scrollTo(0);
}

void ViewsStrip::updateViews(std::vector<QImage> pictures) {
  const int width_before = contentWidth();
  pictures_ = std::move(pictures);
  // New views are added at the left.
  scrollTo(offset_ > 0 ? offset_ + contentWidth() - width_before : 0);
}

int ViewsStrip::contentWidth() const {
  int sum = 0;
  for (const QImage& picture : pictures_) sum += widthOf(picture, height() - 2 * kMargin) + kPictureGap;
  return sum;
}

void ViewsStrip::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors& colors = Theme::instance().colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  if (pictures_.empty()) {
    painter.setPen(colors.muted_text);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, note_);
    return;
  }
  int x = -offset_;
  for (const QImage& picture : pictures_) {
    const int picture_height = height() - 2 * kMargin;
    const QRect cell(x, kMargin, widthOf(picture, picture_height), picture_height);
    QPainterPath shape;
    shape.addRoundedRect(cell, 6, 6);
    painter.save();
    painter.setClipPath(shape);
    painter.fillRect(cell, colors.dark ? QColor(0x15, 0x17, 0x1b) : QColor(0xe4, 0xe8, 0xed));
    const QSize fitted = picture.size().scaled(cell.size(), Qt::KeepAspectRatio);
    painter.drawImage(QRect(cell.center() - QPoint(fitted.width() / 2 - 1, fitted.height() / 2 - 1), fitted),
                      picture);
    painter.restore();
    x += cell.width() + kPictureGap;
  }
  if (hasFocus()) {
    painter.setPen(QPen(colors.accent, 1));
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
  }
}

void ViewsStrip::scrollTo(int offset) {
  offset_ = std::clamp(offset, 0, std::max(0, contentWidth() - width()));
  update();
}

void ViewsStrip::wheelEvent(QWheelEvent* event) {
  const QPoint turn = event->angleDelta();
  scrollTo(offset_ - (turn.x() != 0 ? turn.x() : turn.y()) / 2);
  event->accept();
}

void ViewsStrip::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
    scrollTo(offset_ + (event->key() == Qt::Key_Left ? -kKeyStep : kKeyStep));
  } else {
    QWidget::keyPressEvent(event);
  }
}

}  // namespace scantrove
