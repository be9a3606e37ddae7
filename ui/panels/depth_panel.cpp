#include "ui/panels/depth_panel.h"

#include <QLocale>
#include <QPainter>
#include <algorithm>

namespace scantrove {

void DepthPanel::setDepth(const cv::Mat& depth_m, const DepthRange& range) {
  range_ = range;
  setPicture(depthPicture(depth_m, range));
}

void DepthPanel::paintOverlay(QPainter& painter, const QRectF& rect) {
  QFont font = painter.font();
  font.setPointSizeF(font.pointSizeF() * 0.78);
  painter.setFont(font);
  const QFontMetricsF metrics(font);
  const double bar_width = std::clamp(rect.width() * 0.24, 40.0, 90.0);
  const QLocale locale;
  const QString near_text = locale.toString(static_cast<double>(range_.near_m), 'f', 1);
  const QString far_text = tr("%1 m").arg(locale.toString(static_cast<double>(range_.far_m), 'f', 1));
  const double near_width = metrics.horizontalAdvance(near_text);
  const double far_width = metrics.horizontalAdvance(far_text);
  const double width = near_width + far_width + bar_width + 18;
  const QRectF chip(rect.right() - width - 6, rect.top() + 6, width, metrics.height() + 4);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 18, 175));
  painter.drawRoundedRect(chip, 4, 4);
  painter.setPen(QColor(0xf1, 0xf3, 0xf6));
  painter.drawText(chip.adjusted(5, 0, -5, 0), Qt::AlignVCenter | Qt::AlignLeft, near_text);
  painter.drawText(chip.adjusted(5, 0, -5, 0), Qt::AlignVCenter | Qt::AlignRight, far_text);
  painter.drawImage(QRectF(chip.left() + near_width + 9, chip.center().y() - 3, bar_width, 6),
                    depthLegend(static_cast<int>(bar_width)));
}

}  // namespace scantrove
