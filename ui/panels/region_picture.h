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

/// What of a picture is lit up: the region under the pointer lightly, the selected ones strongly, in yellow
/// with a line around. `region_ids`: CV_32SC1 by pixel of the view. Transparent elsewhere; null when nothing
/// is lit.
[[nodiscard]] QImage litPicture(const cv::Mat& region_ids, RegionId hovered,
                                const std::vector<RegionId>& selected);

/// A name tag beside the pointer, within `room`. `text`: lines; the first is the name.
void paintPointerTag(QPainter& painter, const QPointF& pointer, const QRectF& room, const QStringList& text);

/// A line along `places` (of the painter) that is to be seen on any picture, as a person draws it.
void paintStroke(QPainter& painter, const QPolygonF& places, const QColor& color);
/// A dot at each of the places, for what was drawn before.
void paintMarks(QPainter& painter, const QPolygonF& places, const QColor& color);

/// Regions of which at least half of the pixels lie in `band` (pixels of `region_ids`).
[[nodiscard]] std::vector<RegionId> regionsIn(const cv::Mat& region_ids, const cv::Rect& band);

}  // namespace scantrove
