#pragma once
#include <QRectF>
#include <vector>

namespace scantrove {

/// A label to be placed beside its box, in pixels.
struct LabelRequest {
  QRectF box;
  QSizeF size;  ///< of the label
};

/// Places labels inside `bounds` so that they do not overlap: above the box at the left if free, else at
/// another side of the box, else a little further away. Earlier requests have priority; equal requests give
/// equal results. Without free room near its box a label has no place: a null rectangle.
[[nodiscard]] std::vector<QRectF> placeLabels(const std::vector<LabelRequest>& requests,
                                              const QRectF& bounds);

}  // namespace scantrove
