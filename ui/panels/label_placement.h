#pragma once
#include <QRectF>
#include <vector>

namespace scantrove {

/// A label that is to stand beside its box; all in pixels.
struct LabelRequest {
  QRectF box;
  QSizeF size;  ///< of the label
};

/// Where each label goes so that none covers another: above its box at the left where that is free, else at
/// another side of the box, else further down beside it. All stay inside `bounds`. The first of `requests`
/// chooses first; the same requests give the same places. Where there is no room left, labels overlap as
/// little as they can.
[[nodiscard]] std::vector<QRectF> placeLabels(const std::vector<LabelRequest>& requests,
                                              const QRectF& bounds);

}  // namespace scantrove
