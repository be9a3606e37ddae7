#pragma once
#include <QColor>
#include <QImage>
#include <QPolygonF>
#include <QRectF>
#include <opencv2/core/mat.hpp>
#include <set>
#include <vector>

#include "core/base/ids.h"

class QPainter;

namespace scantrove {

/// Image that highlights the region under the pointer in white and the selected regions in yellow, with
/// outlines. `region_ids`: CV_32SC1 by pixel of the view. Transparent elsewhere; null if nothing is
/// highlighted.
[[nodiscard]] QImage highlightPicture(const cv::Mat& region_ids, RegionId hovered,
                                      const std::vector<RegionId>& selected);

/// Paints a tag beside the pointer, within `room`. `text`: lines; the first is the name.
void paintPointerTag(QPainter& painter, const QPointF& pointer, const QRectF& room, const QStringList& text);

/// Paints the stroke that the user draws, along `points`, visible on any picture.
void paintStroke(QPainter& painter, const QPolygonF& points, const QColor& color);
/// Paints a dot at each of the points.
void paintMarks(QPainter& painter, const QPolygonF& points, const QColor& color);

/// Regions with at least half of their pixels in `band` (in pixels of `region_ids`).
[[nodiscard]] std::vector<RegionId> regionsIn(const cv::Mat& region_ids, const cv::Rect& band);

}  // namespace scantrove
