#include "ui/panels/coverage_ring.h"

#include <QPainter>
#include <QPainterPath>

#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr double kGap_deg = 4;  // between sides
constexpr double kHole = 0.62;  // inner radius as a fraction of the outer

QPainterPath sector(const QRectF& outer, const QRectF& inner, double from_deg, double span_deg) {
  QPainterPath path;
  path.arcMoveTo(outer, from_deg);
  path.arcTo(outer, from_deg, span_deg);
  path.arcTo(inner, from_deg + span_deg, -span_deg);
  path.closeSubpath();
  return path;
}

}  // namespace

void paintCoverageRing(QPainter* painter, const QRectF& square, const SeenSides& seen,
                       const ThemeColors& colors) {
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(Qt::NoPen);
  const QColor filled = seen.isComplete() ? colors.good : colors.accent;
  QColor open = colors.muted_text;
  open.setAlpha(70);
  const double margin = square.width() * (1 - kHole) / 2;
  const QRectF hole = square.adjusted(margin, margin, -margin, -margin);
  constexpr double kSide_deg = 360.0 / SeenSides::kSides;
  for (std::size_t side = 0; side < SeenSides::kSides; ++side) {
    // Qt's angles are counterclockwise, with 0 on the right.
    const double middle_deg = 270 + kSide_deg * static_cast<double>(side);
    painter->setBrush(seen.sides[side] ? filled : open);
    painter->drawPath(sector(square, hole, middle_deg - kSide_deg / 2 + kGap_deg / 2, kSide_deg - kGap_deg));
  }
  const double inset = hole.width() * 0.24;
  const QRectF middle = hole.adjusted(inset, inset, -inset, -inset);
  if (seen.isComplete()) {
    icon(QStringLiteral("confirm"), colors.good).paint(painter, hole.toAlignedRect());
  } else {
    painter->setBrush(seen.above ? filled : open);
    painter->drawEllipse(middle);
  }
  painter->restore();
}

}  // namespace scantrove
