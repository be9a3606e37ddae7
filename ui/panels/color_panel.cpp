#include "ui/panels/color_panel.h"

#include <QPainter>

namespace scantrove {
namespace {
const QColor kFound(255, 255, 255);
const QColor kRecognised(0, 255, 255);
}  // namespace

ColorPanel::ColorPanel(QWidget* parent)
    : ImagePanel(
          tr("Colour and objects"),
          tr("The camera's picture. White rectangles: objects found. Cyan names: objects known from the "
             "catalogue. White names: objects new in this scan; “?”: still being watched."),
          parent) {}

void ColorPanel::setFrame(const QImage& picture, const std::vector<SeenObject>& objects) {
  objects_ = objects;
  setPicture(picture);
}

QRectF ColorPanel::objectRect(const SeenObject& object) const {
  const QRectF frame = pictureRect();
  const cv::Rect2f& box = object.box;
  return {frame.left() + static_cast<double>(box.x) * frame.width(),
          frame.top() + static_cast<double>(box.y) * frame.height(),
          static_cast<double>(box.width) * frame.width(), static_cast<double>(box.height) * frame.height()};
}

QString ColorPanel::nameOf(const SeenObject& object) const {
  if (!object.object) return QStringLiteral("?");
  const QString now = name_of_ ? name_of_(object.object) : QString();
  return now.isEmpty() ? QString::fromStdString(object.name) : now;
}

void ColorPanel::paintOverlay(QPainter& painter, const QRectF& rect) {
  QFont font = painter.font();
  font.setPointSizeF(font.pointSizeF() * (rect.width() > 300 ? 0.92 : 0.78));
  font.setBold(true);
  painter.setFont(font);
  const double chip_height = QFontMetricsF(font).height() + 3;
  for (const SeenObject& object : objects_) {
    const QRectF box = objectRect(object);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 110), 3.6));
    painter.drawRect(box);
    painter.setPen(QPen(kFound, 1.8));
    painter.drawRect(box);
    const double top =
        box.top() - chip_height - 2 >= rect.top() ? box.top() - chip_height - 2 : box.top() + 2;
    paintChip(painter, QPointF(box.left(), top), nameOf(object), object.recognised ? kRecognised : kFound);
  }
}

}  // namespace scantrove
