#include "ui/painting/image_canvas.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/panels/image_panel.h"
#include "ui/panels/region_picture.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr double kStepOfKey = 1.5, kStepOfWheel = 1.25;
constexpr double kDegreesPerStep = 120;  // QWheelEvent's eighths of a degree of one notch
const QColor kBackground(0x15, 0x17, 0x1b);
const QColor kOutline(0xff, 0xd0, 0x00);

bool isZoomIn(const QKeyEvent& key) {
  return key.modifiers().testFlag(Qt::ControlModifier) &&
         (key.key() == Qt::Key_Plus || key.key() == Qt::Key_Equal);
}
bool isZoomOut(const QKeyEvent& key) {
  return key.modifiers().testFlag(Qt::ControlModifier) && key.key() == Qt::Key_Minus;
}
bool isFit(const QKeyEvent& key) {
  return key.modifiers().testFlag(Qt::ControlModifier) && key.key() == Qt::Key_0;
}
bool isPlain(const QKeyEvent& key, int one, int other) {
  return (key.key() == one || key.key() == other) &&
         (key.modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
}

}  // namespace

ImageCanvas::ImageCanvas(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(240, 180);
  setObjectName(QStringLiteral("imageCanvas"));
  setAccessibleName(tr("Image"));
  setAccessibleDescription(tr("The image of the current frame, in which masks are painted."));
}

void ImageCanvas::setLayers(const Layers& layers, const QSize& size) {
  const QImage highlight = layers_.highlight;
  layers_ = layers;
  layers_.highlight = highlight;  // setHighlight() changes it
  size_ = size;
  zoom_.setSizes(size, this->size());
  update();
}

void ImageCanvas::setHighlight(const QImage& highlight) {
  if (highlight.isNull() && layers_.highlight.isNull()) return;
  layers_.highlight = highlight;
  update();
}

void ImageCanvas::showDraft(const cv::Mat& draft, const QRect& changed, const QColor& color) {
  const QSize drawn(draft.cols, draft.rows);
  if (draft_.size() != drawn) draft_ = emptyDraft(drawn);
  paintDraft(draft_, draft, changed, color);
  const QRectF part(zoom_.toView(changed.topLeft()),
                    zoom_.toView(QPointF(changed.right() + 1, changed.bottom() + 1)));
  update(part.toAlignedRect().adjusted(-2, -2, 2, 2));
}

void ImageCanvas::setOutline(const QPolygonF& outline) {
  if (outline.isEmpty() && outline_.isEmpty()) return;
  outline_ = outline;
  update();
}

void ImageCanvas::setNames(std::vector<MaskName> names) {
  names_ = std::move(names);
  update();
}

void ImageCanvas::setBrushRadius(std::optional<double> radius_px) {
  if (radius_px == brush_px_) return;
  brush_px_ = radius_px;
  showCursor();
  update();
}

void ImageCanvas::setTag(const QStringList& tag) {
  if (tag == tag_) return;
  tag_ = tag;
  update();
}

void ImageCanvas::setEmptyText(const QString& text) {
  empty_text_ = text;
  update();
}

void ImageCanvas::zoomAt(const QPointF& at, double factor) {
  zoom_.zoomAt(at, factor);
  update();
}

void ImageCanvas::fit() {
  zoom_.fit();
  update();
}

QPointF ImageCanvas::pixelAt(const QPointF& in_widget) const {
  return zoom_.toImage(in_widget) - QPointF(0.5, 0.5);
}

bool ImageCanvas::takes(const QKeyEvent& key) const {
  if (isZoomIn(key) || isZoomOut(key) || isFit(key)) return true;
  if (isPlain(key, Qt::Key_Space, Qt::Key_V)) return true;
  if (!are_keys_taken_) return false;
  return isPlain(key, Qt::Key_Escape, Qt::Key_Backspace) || isPlain(key, Qt::Key_Return, Qt::Key_Enter);
}

bool ImageCanvas::event(QEvent* event) {
  // The window uses some of these keys for other things.
  if (event->type() == QEvent::ShortcutOverride && takes(*static_cast<QKeyEvent*>(event))) {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

void ImageCanvas::keyPressEvent(QKeyEvent* event) {
  if (!takes(*event)) return QWidget::keyPressEvent(event);
  if (event->isAutoRepeat() && event->key() == Qt::Key_Space) return;
  const QPointF middle = pointer_.value_or(QRectF(rect()).center());
  if (isZoomIn(*event)) return zoomAt(middle, kStepOfKey);
  if (isZoomOut(*event)) return zoomAt(middle, 1 / kStepOfKey);
  if (isFit(*event)) return fit();
  switch (event->key()) {
    case Qt::Key_Space:
      is_space_down_ = true;
      return showCursor();
    case Qt::Key_V:
      emit nextPictureRequested();
      return;
    case Qt::Key_Escape:
      emit cancelled();
      return;
    case Qt::Key_Backspace:
      emit steppedBack();
      return;
    default:
      emit completed();
  }
}

void ImageCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Space || event->isAutoRepeat()) return QWidget::keyReleaseEvent(event);
  is_space_down_ = false;
  showCursor();
}

void ImageCanvas::focusOutEvent(QFocusEvent* event) {
  is_space_down_ = false;
  showCursor();
  QWidget::focusOutEvent(event);
}

void ImageCanvas::showCursor() {
  if (is_space_down_ || panned_from_) {
    setCursor(panned_from_ ? Qt::ClosedHandCursor : Qt::OpenHandCursor);
  } else {
    setCursor(brush_px_ ? Qt::CrossCursor : Qt::ArrowCursor);
  }
}

void ImageCanvas::resizeEvent(QResizeEvent* /*event*/) { zoom_.setSizes(size_, size()); }

void ImageCanvas::wheelEvent(QWheelEvent* event) {
  const double steps = event->angleDelta().y() / kDegreesPerStep;
  event->accept();
  if (event->modifiers().testFlag(Qt::ControlModifier)) {
    if (steps != 0) emit brushStepped(steps > 0 ? 1 : -1);
    return;
  }
  zoomAt(event->position(), std::pow(kStepOfWheel, steps));
}

void ImageCanvas::mousePressEvent(QMouseEvent* event) {
  const bool pans =
      event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && is_space_down_);
  if (pans) {
    panned_from_ = event->position();
    return showCursor();
  }
  if (event->button() != Qt::LeftButton || layers_.picture.isNull()) return;
  is_drawing_ = true;
  emit pressed(pixelAt(event->position()));
}

void ImageCanvas::mouseMoveEvent(QMouseEvent* event) {
  pointer_ = event->position();
  if (panned_from_) {
    zoom_.pan(*pointer_ - *panned_from_);
    panned_from_ = pointer_;
  } else if (is_drawing_) {
    emit dragged(pixelAt(*pointer_));
  } else {
    emit pointedAt(pixelAt(*pointer_));
  }
  update();  // circle and tag move with the pointer
}

void ImageCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (panned_from_) {
    panned_from_.reset();
    return showCursor();
  }
  if (event->button() != Qt::LeftButton || !std::exchange(is_drawing_, false)) return;
  emit released(pixelAt(event->position()), event->modifiers());
}

void ImageCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  const bool is_press = event->button() != Qt::LeftButton || is_space_down_ || do_double_clicks_draw_;
  if (is_press || layers_.picture.isNull()) return mousePressEvent(event);
  emit doubleClicked(pixelAt(event->position()), event->globalPosition().toPoint());
}

void ImageCanvas::contextMenuEvent(QContextMenuEvent* event) {
  const bool by_key = event->reason() == QContextMenuEvent::Keyboard;
  const QPointF place = by_key ? QPointF(rect().center()) : QPointF(event->pos());
  emit menuRequested(pixelAt(place), mapToGlobal(place.toPoint()));
}

void ImageCanvas::leaveEvent(QEvent* /*event*/) {
  pointer_.reset();
  emit pointerLeft();
  update();
}

void ImageCanvas::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.fillRect(event->rect(), kBackground);
  if (layers_.picture.isNull()) {
    painter.setPen(Theme::instance().colors().muted_text);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, empty_text_);
    return;
  }
  const QRectF place = zoom_.imageRect();
  const auto draw = [&](const QImage& image, double opacity) {
    if (image.isNull() || opacity <= 0) return;
    // Only the visible part, because a large scale would make Qt scale the rest as well.
    const QRectF visible = place & QRectF(event->rect()).adjusted(-1, -1, 1, 1);
    if (visible.isEmpty()) return;
    const double sx = image.width() / place.width(), sy = image.height() / place.height();
    QRect pixels = QRectF((visible.left() - place.left()) * sx, (visible.top() - place.top()) * sy,
                          visible.width() * sx, visible.height() * sy)
                       .toAlignedRect();
    pixels = pixels.adjusted(-1, -1, 1, 1) & image.rect();
    const QRectF target(place.left() + pixels.left() / sx, place.top() + pixels.top() / sy,
                        pixels.width() / sx, pixels.height() / sy);
    painter.setOpacity(opacity);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, sx > 1);
    painter.drawImage(target, image, pixels);
    painter.setOpacity(1);
  };
  draw(layers_.picture, 1);
  draw(layers_.second, layers_.second_opacity);
  draw(layers_.masks, layers_.masks_opacity);
  draw(layers_.highlight, 1);
  draw(draft_, 1);
  paintPointer(painter);
}

void ImageCanvas::paintPointer(QPainter& painter) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const MaskName& name : names_) {
    const QSizeF size = chipSize(painter, name.text);
    const QPointF middle = zoom_.toView(name.at);
    paintChip(painter, middle - QPointF(size.width() / 2, size.height() / 2), name.text, Qt::white);
  }
  if (!outline_.isEmpty()) {
    QPolygonF line;
    for (const QPointF& point : outline_) line << positionOf(point);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 160), 3));
    painter.drawPolyline(line);
    painter.setPen(QPen(kOutline, 1.4));
    painter.drawPolyline(line);
    painter.setBrush(kOutline);
    painter.drawRect(QRectF(line.first() - QPointF(3, 3), QSizeF(6, 6)));
  }
  if (!pointer_ || panned_from_) return;
  if (brush_px_) {
    const double radius = std::max(1.0, *brush_px_ * zoom_.scale());
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 170), 3));
    painter.drawEllipse(*pointer_, radius, radius);
    painter.setPen(QPen(Qt::white, 1.2));
    painter.drawEllipse(*pointer_, radius, radius);
  }
  if (!is_drawing_) paintPointerTag(painter, *pointer_, rect(), tag_);
}

}  // namespace scantrove
