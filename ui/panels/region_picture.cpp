#include "ui/panels/region_picture.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <map>

namespace scantrove {
namespace {

constexpr QRgb kHoverFill = 0x4dffffffU;
constexpr QRgb kHoverLine = 0xffffffffU;
constexpr QRgb kSelectedFill = 0x59ffd000U;
constexpr QRgb kSelectedLine = 0xffffd000U;
constexpr double kStrokeWidth_px = 4;
constexpr double kMarkRadius_px = 2.5;
const QColor kStrokeCasing(12, 14, 18, 200);

}  // namespace

QImage highlightPicture(const cv::Mat& region_ids, RegionId hovered, const std::vector<RegionId>& selected) {
  if (region_ids.empty() || region_ids.type() != CV_32SC1 || (!hovered && selected.empty())) return {};
  const auto kind = [&](std::int32_t id) {
    if (id <= 0) return 0;
    const RegionId region{static_cast<std::uint32_t>(id)};
    if (std::ranges::find(selected, region) != selected.end()) return 2;
    return region == hovered ? 1 : 0;
  };
  QImage picture(region_ids.cols, region_ids.rows, QImage::Format_ARGB32);
  bool any = false;
  std::int32_t last = 0;  // neighbouring pixels mostly have the same id
  int last_kind = 0;
  for (int y = 0; y < region_ids.rows; ++y) {
    const auto* row = region_ids.ptr<std::int32_t>(y);
    const auto* above = y > 0 ? region_ids.ptr<std::int32_t>(y - 1) : nullptr;
    const auto* below = y + 1 < region_ids.rows ? region_ids.ptr<std::int32_t>(y + 1) : nullptr;
    auto* out = reinterpret_cast<QRgb*>(picture.scanLine(y));
    for (int x = 0; x < region_ids.cols; ++x) {
      if (row[x] != last) {
        last = row[x];
        last_kind = kind(last);
      }
      out[x] = 0;
      if (last_kind == 0) continue;
      any = true;
      const bool is_edge = x == 0 || x + 1 == region_ids.cols || row[x - 1] != last || row[x + 1] != last ||
                           above == nullptr || below == nullptr || above[x] != last || below[x] != last;
      if (last_kind == 2) {
        out[x] = is_edge ? kSelectedLine : kSelectedFill;
      } else {
        out[x] = is_edge ? kHoverLine : kHoverFill;
      }
    }
  }
  return any ? picture : QImage();
}

void paintPointerTag(QPainter& painter, const QPointF& pointer, const QRectF& room, const QStringList& text) {
  if (text.isEmpty()) return;
  painter.save();
  QFont bold = painter.font();
  bold.setBold(true);
  const QFontMetricsF usual_metrics(painter.font());
  const QFontMetricsF bold_metrics(bold);
  double width = bold_metrics.horizontalAdvance(text.first());
  for (const QString& line : text.mid(1)) width = std::max(width, usual_metrics.horizontalAdvance(line));
  const double line_height = bold_metrics.height();
  QRectF tag(pointer + QPointF(16, 14),
             QSizeF(width + 16, line_height * static_cast<double>(text.size()) + 8));
  if (tag.right() > room.right()) tag.moveRight(pointer.x() - 10);
  if (tag.bottom() > room.bottom()) tag.moveBottom(pointer.y() - 10);
  tag.moveLeft(std::max(tag.left(), room.left()));
  tag.moveTop(std::max(tag.top(), room.top()));
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 18, 215));
  painter.drawRoundedRect(tag, 5, 5);
  const QFont usual = painter.font();
  for (int i = 0; i < text.size(); ++i) {
    painter.setFont(i == 0 ? bold : usual);
    painter.setPen(i == 0 ? QColor(0xff, 0xff, 0xff) : QColor(0xc4, 0xca, 0xd3));
    painter.drawText(QRectF(tag.left() + 8, tag.top() + 4 + line_height * i, tag.width() - 16, line_height),
                     Qt::AlignVCenter | Qt::AlignLeft, text[i]);
  }
  painter.restore();
}

void paintStroke(QPainter& painter, const QPolygonF& points, const QColor& color) {
  painter.save();
  painter.setBrush(Qt::NoBrush);
  const auto draw = [&](const QColor& line_color, double width_px) {
    painter.setPen(QPen(line_color, width_px, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    points.size() == 1 ? painter.drawPoint(points.first()) : painter.drawPolyline(points);
  };
  draw(kStrokeCasing, kStrokeWidth_px + 3);
  draw(color, kStrokeWidth_px);
  painter.restore();
}

void paintMarks(QPainter& painter, const QPolygonF& points, const QColor& color) {
  painter.save();
  painter.setPen(QPen(kStrokeCasing, 1));
  painter.setBrush(color);
  for (const QPointF& point : points) painter.drawEllipse(point, kMarkRadius_px, kMarkRadius_px);
  painter.restore();
}

std::vector<RegionId> regionsIn(const cv::Mat& region_ids, const cv::Rect& band) {
  struct Count {
    int all = 0, inside = 0;
  };
  std::map<std::int32_t, Count> counts;
  for (int y = 0; y < region_ids.rows; ++y) {
    const auto* row = region_ids.ptr<std::int32_t>(y);
    for (int x = 0; x < region_ids.cols; ++x) {
      if (row[x] <= 0) continue;
      Count& count = counts[row[x]];
      ++count.all;
      if (band.contains(cv::Point(x, y))) ++count.inside;
    }
  }
  std::vector<RegionId> regions;
  for (const auto& [id, count] : counts) {
    if (2 * count.inside >= count.all) regions.push_back(RegionId{static_cast<std::uint32_t>(id)});
  }
  return regions;
}

}  // namespace scantrove
