#pragma once
#include <QRectF>

#include "core/geometry/view_coverage.h"

class QPainter;

namespace scantrove {

struct ThemeColors;

/// A thing as seen from above, in the middle of the ring of its sides: what was seen is filled in, the first
/// side at the bottom; the disc in the middle stands for above. With a tick when all sides were seen.
void paintCoverageRing(QPainter* painter, const QRectF& square, const SeenSides& seen,
                       const ThemeColors& colors);

}  // namespace scantrove
