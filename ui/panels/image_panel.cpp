#include "ui/panels/image_panel.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <utility>

#include "ui/panels/region_picture.h"
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
  setMinimumSize(48, 36);
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(title);
  setAccessibleDescription(explanation);
  setLarge(false);
}

void ImagePanel::setLarge(bool large) {
  setToolTip(QStringLiteral("<b>%1</b><br>%2<br><i>%3</i>")
                 .arg(title_, accessibleDescription(),
                      large ? tr("Click the title to enlarge the colour image again, twice for image mode")
                            : tr("Click the title to enlarge, twice for image mode")));
}

void ImagePanel::setHighlight(const QImage& highlight) {
  if (highlight.isNull() && highlight_.isNull()) return;
  highlight_ = highlight;
  update();
}

void ImagePanel::setTag(const QStringList& tag) {
  if (tag == tag_) return;
  tag_ = tag;
  update();
}

void ImagePanel::setStrokeColor(const std::optional<QColor>& color) {
  if (color == stroke_color_) return;
  stroke_color_ = color;
  if (!stroke_.isEmpty()) is_cancelled_ = true;
  stroke_.clear();
  update();
}

void ImagePanel::setMarks(std::vector<Marks> marks) {
  if (marks.empty() && marks_.empty()) return;
  marks_ = std::move(marks);
  update();
}

void ImagePanel::setPicture(const QImage& picture) {
  picture_ = picture;
  update();
}

void ImagePanel::setEmptyText(const QString& text) {
  if (text == empty_text_) return;
  empty_text_ = text;
  update();
}

QRectF ImagePanel::pictureRect() const {
  if (picture_.isNull()) return {};
  const QSizeF fitted = QSizeF(picture_.size()).scaled(size(), Qt::KeepAspectRatio);
  return {QPointF((width() - fitted.width()) / 2, (height() - fitted.height()) / 2), fitted};
}

QFont ImagePanel::smallFont() const {
  QFont small = font();
  small.setPointSizeF(font().pointSizeF() * 0.86);
  return small;
}

QRectF ImagePanel::titleRect() const {
  if (picture_.isNull()) return rect();
  const QFontMetricsF metrics(smallFont());
  const double height = metrics.height() + 3;
  const QString title = metrics.elidedText(title_, Qt::ElideRight, width() - 22);
  return {6.5, this->height() - 6.5 - height, metrics.horizontalAdvance(title) + 10, height};
}

std::optional<QPointF> ImagePanel::fractionAt(const QPointF& place) const {
  const QRectF frame = pictureRect();
  if (frame.isEmpty() || !frame.contains(place)) return std::nullopt;
  return QPointF((place.x() - frame.left()) / frame.width(), (place.y() - frame.top()) / frame.height());
}

QPointF ImagePanel::positionOf(const QPointF& fraction) const {
  const QRectF frame = pictureRect();
  return {frame.left() + fraction.x() * frame.width(), frame.top() + fraction.y() * frame.height()};
}

QRectF ImagePanel::band() const {
  return is_band_ ? QRectF(*pressed_, *pointer_).normalized() & pictureRect() : QRectF();
}

void ImagePanel::paintPointing(QPainter& painter) {
  if (!highlight_.isNull()) painter.drawImage(pictureRect(), highlight_);
  if (is_band_) {
    painter.setPen(QPen(QColor(0xff, 0xd0, 0x00), 1, Qt::DashLine));
    painter.setBrush(QColor(0xff, 0xd0, 0x00, 40));
    painter.drawRect(band());
  }
  for (const Marks& marks : marks_) {
    QPolygonF places;
    for (const QPointF& fraction : marks.fractions) places << positionOf(fraction);
    paintMarks(painter, places, marks.color);
  }
  if (!stroke_.isEmpty() && stroke_color_) {
    painter.save();
    painter.setClipRect(pictureRect());
    paintStroke(painter, stroke_.points(), *stroke_color_);
    painter.restore();
  }
  if (pointer_ && !is_band_) paintPointerTag(painter, *pointer_, rect(), tag_);
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
  painter.setFont(font());

  painter.setPen(QPen(hasFocus() ? colors.accent : colors.outline, hasFocus() ? 2 : 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(outline);
  paintTitle(painter, card);
  painter.setFont(font());
  if (!picture_.isNull()) paintPointing(painter);
}

void ImagePanel::paintTitle(QPainter& painter, const QRectF& card) {
  painter.setFont(smallFont());
  if (picture_.isNull()) {
    painter.setPen(Theme::instance().colors().muted_text);
    const QString text = empty_text_.isEmpty() ? title_ : title_ + QLatin1Char('\n') + empty_text_;
    painter.drawText(card, Qt::AlignCenter | Qt::TextWordWrap, text);
    return;
  }
  const QString title = QFontMetricsF(smallFont()).elidedText(title_, Qt::ElideRight, card.width() - 22);
  paintChip(painter, titleRect().topLeft(), title, QColor(0xf1, 0xf3, 0xf6));
}

void ImagePanel::paintOverlay(QPainter& /*painter*/, const QRectF& /*rect*/) {}

void ImagePanel::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  pressed_ = event->position();
  is_cancelled_ = false;
}

void ImagePanel::drag() {
  const bool far = (*pointer_ - *pressed_).manhattanLength() > QApplication::startDragDistance();
  if (is_band_ || is_cancelled_ || !far) return;
  if (!stroke_color_) {
    is_band_ = true;
  } else if (stroke_.isEmpty()) {
    stroke_.begin(*pressed_);
    drawStroke({*pressed_});
  }
}

void ImagePanel::drawStroke(const QPolygonF& places) {
  for (const QPointF& place : places) {
    if (const auto fraction = fractionAt(place)) emit strokeAt(*fraction);
    if (stroke_.isEmpty()) return;  // a receiver cancelled it
  }
}

void ImagePanel::endStroke(const QMouseEvent& event) {
  drawStroke(stroke_.extend(event.position()));
  stroke_.clear();
  emit strokeEnded(event.modifiers());
}

void ImagePanel::mouseMoveEvent(QMouseEvent* event) {
  pointer_ = event->position();
  const Qt::CursorShape usual = stroke_color_ ? Qt::CrossCursor : Qt::ArrowCursor;
  setCursor(titleRect().contains(*pointer_) ? Qt::PointingHandCursor : usual);
  const bool drags = pressed_ && event->buttons().testFlag(Qt::LeftButton) && !picture_.isNull();
  if (drags) drag();
  if (!stroke_.isEmpty()) drawStroke(stroke_.extend(*pointer_));
  if (is_band_ || is_cancelled_ || !stroke_.isEmpty()) {
    update();
    return;
  }
  if (const auto fraction = fractionAt(*pointer_)) {
    emit pointedAt(*fraction);
  } else {
    emit pointerLeft();
  }
  if (!tag_.isEmpty()) update();  // it moves with the pointer
}

void ImagePanel::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !pressed_) return;
  const QPointF pressed = *pressed_;
  const QRectF drawn = band();
  pressed_.reset();
  update();
  if (std::exchange(is_cancelled_, false)) return;
  if (!stroke_.isEmpty()) return endStroke(*event);
  if (std::exchange(is_band_, false)) {
    const QRectF frame = pictureRect();
    if (drawn.isEmpty()) return;
    emit bandDrawn(
        {(drawn.left() - frame.left()) / frame.width(), (drawn.top() - frame.top()) / frame.height(),
         drawn.width() / frame.width(), drawn.height() / frame.height()},
        event->modifiers());
    return;
  }
  if (std::exchange(is_double_click_, false)) return;
  if (titleRect().contains(pressed) && titleRect().contains(event->position())) {
    emit activated();
  } else if (const auto fraction = fractionAt(event->position())) {
    emit clicked(*fraction, event->modifiers());
  }
}

void ImagePanel::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return mousePressEvent(event);
  is_double_click_ = true;
  pressed_ = event->position();
  if (titleRect().contains(event->position())) {
    emit opened();
    return;
  }
  if (const auto fraction = fractionAt(event->position())) emit doubleClicked(*fraction);
}

void ImagePanel::contextMenuEvent(QContextMenuEvent* event) {
  const bool by_key = event->reason() == QContextMenuEvent::Keyboard;
  const QPointF place = by_key ? QPointF(rect().center()) : QPointF(event->pos());
  if (const auto fraction = fractionAt(place)) emit menuRequested(*fraction, mapToGlobal(place.toPoint()));
}

void ImagePanel::leaveEvent(QEvent* /*event*/) {
  pointer_.reset();
  emit pointerLeft();
  update();
}

}  // namespace scantrove
