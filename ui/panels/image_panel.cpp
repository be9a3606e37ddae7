#include "ui/panels/image_panel.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include "ui/theme/theme.h"

namespace scantrove {
namespace {
constexpr double kRadius = 7;
}

QSizeF chipSize(const QPainter& painter, const QString& text) {
  const QFontMetricsF metrics(painter.font());
  return {metrics.horizontalAdvance(text) + 10, metrics.height() + 3};
}

void paintChip(QPainter& painter, const QPointF& top_left, const QString& text, const QColor& text_color) {
  const QRectF chip(top_left, chipSize(painter, text));
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 18, 175));
  painter.drawRoundedRect(chip, 4, 4);
  painter.setPen(text_color);
  painter.drawText(chip, Qt::AlignCenter, text);
}

ImagePanel::ImagePanel(const QString& title, const QString& explanation, QWidget* parent)
    : QWidget(parent), title_(title) {
  setMinimumSize(96, 72);
  setFocusPolicy(Qt::TabFocus);
  setAccessibleName(title);
  setAccessibleDescription(explanation);
  setClickMeaning({});
}

void ImagePanel::setClickMeaning(const QString& meaning) {
  has_click_meaning_ = !meaning.isEmpty();
  setToolTip(QStringLiteral("<b>%1</b><br>%2").arg(title_, accessibleDescription()) +
             (meaning.isEmpty() ? QString() : QStringLiteral("<br><i>%1</i>").arg(meaning)));
  setCursor(meaning.isEmpty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
}

void ImagePanel::setPicture(const QImage& picture) {
  picture_ = picture;
  update();
}

QRectF ImagePanel::pictureRect() const {
  if (picture_.isNull()) return {};
  const QSizeF fitted = QSizeF(picture_.size()).scaled(size(), Qt::KeepAspectRatio);
  return {QPointF((width() - fitted.width()) / 2, (height() - fitted.height()) / 2), fitted};
}

void ImagePanel::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors& colors = Theme::instance().colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const QRectF card = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  QPainterPath outline;
  outline.addRoundedRect(card, kRadius, kRadius);

  painter.save();
  painter.setClipPath(outline);
  painter.fillRect(rect(), picture_.isNull() ? colors.surface : QColor(0x15, 0x17, 0x1b));
  if (!picture_.isNull()) {
    painter.drawImage(pictureRect(), picture_);
    paintOverlay(painter, pictureRect());
  }
  painter.restore();

  painter.setPen(QPen(hasFocus() ? colors.accent : colors.outline, hasFocus() ? 2 : 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(outline);
  paintTitle(painter, card);
}

void ImagePanel::paintTitle(QPainter& painter, const QRectF& card) {
  QFont small = font();
  small.setPointSizeF(font().pointSizeF() * 0.86);
  painter.setFont(small);
  if (picture_.isNull()) {
    painter.setPen(Theme::instance().colors().muted_text);
    painter.drawText(card, Qt::AlignCenter, title_);
    return;
  }
  const double height = QFontMetricsF(small).height() + 3;
  const QString title = QFontMetricsF(small).elidedText(title_, Qt::ElideRight, card.width() - 22);
  paintChip(painter, card.bottomLeft() + QPointF(6, -6 - height), title, QColor(0xf1, 0xf3, 0xf6));
}

void ImagePanel::paintOverlay(QPainter& /*painter*/, const QRectF& /*rect*/) {}

void ImagePanel::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && rect().contains(event->position().toPoint())) emit activated();
}

void ImagePanel::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    emit activated();
  } else {
    QWidget::keyPressEvent(event);
  }
}

}  // namespace scantrove
