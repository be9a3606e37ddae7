#pragma once
#include <QRectF>

#include "core/geometry/view_coverage.h"

class QPainter;

namespace scantrove {

struct ThemeColors;

/// A ring of the sides of an object seen from above, the first side at the bottom. Seen sides are filled; the
/// disc in the middle stands for the view from above. Has a tick if all sides were seen.
void paintCoverageRing(QPainter* painter, const QRectF& square, const SeenSides& seen,
                       const ThemeColors& colors);

}  // namespace scantrove
