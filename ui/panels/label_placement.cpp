#include "ui/panels/label_placement.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

constexpr double kLabelGap = 2;
// A label that is further from its box, in heights of a label, seems to belong to another.
constexpr double kFarthest = 3;

bool isFree(const QRectF& label, const std::vector<QRectF>& others) {
  const QRectF with_gap = label.adjusted(-kLabelGap, -kLabelGap, kLabelGap, kLabelGap);
  return std::ranges::none_of(others, [&](const QRectF& other) { return with_gap.intersects(other); });
}

QRectF movedInto(const QRectF& bounds, QRectF label) {
  label.moveLeft(std::max(bounds.left(), std::min(label.left(), bounds.right() - label.width())));
  label.moveTop(std::max(bounds.top(), std::min(label.top(), bounds.bottom() - label.height())));
  return label;
}

/// Possible positions, best first.
std::vector<QRectF> placesFor(const LabelRequest& request, const QRectF& bounds) {
  const QRectF& box = request.box;
  const double width = request.size.width();
  const double height = request.size.height();
  const double above = box.top() - height - kLabelGap;
  const double below = box.bottom() + kLabelGap;
  const double top_inside = box.top() + kLabelGap;
  const double bottom_inside = box.bottom() - height - kLabelGap;
  std::vector<QPointF> corners;
  if (above >= bounds.top()) corners = {{box.left(), above}, {box.right() - width, above}};
  corners.insert(corners.end(), {{box.left(), top_inside}, {box.right() - width, top_inside}});
  if (below + height <= bounds.bottom()) {
    corners.insert(corners.end(), {{box.left(), below}, {box.right() - width, below}});
  }
  corners.insert(corners.end(), {{box.left(), bottom_inside},
                                 {box.right() + kLabelGap, box.top()},
                                 {box.left() - width - kLabelGap, box.top()}});
  std::vector<QRectF> places;
  for (const QPointF& corner : corners) places.push_back(movedInto(bounds, {corner, request.size}));

  // Positions further away, nearest first.
  const auto beside = static_cast<std::ptrdiff_t>(places.size());
  for (double y = bounds.top(); y + height <= bounds.bottom(); y += height + kLabelGap) {
    if (std::abs(y - box.center().y()) > box.height() / 2 + kFarthest * height) continue;
    places.push_back(movedInto(bounds, {QPointF(box.left(), y), request.size}));
  }
  std::stable_sort(places.begin() + beside, places.end(), [&box](const QRectF& a, const QRectF& b) {
    return std::abs(a.top() - box.top()) < std::abs(b.top() - box.top());
  });
  return places;
}

}  // namespace

std::vector<QRectF> placeLabels(const std::vector<LabelRequest>& requests, const QRectF& bounds) {
  std::vector<QRectF> placed;
  for (const LabelRequest& request : requests) {
    const std::vector<QRectF> places = placesFor(request, bounds);
    const auto free =
        std::ranges::find_if(places, [&](const QRectF& place) { return isFree(place, placed); });
    placed.push_back(free == places.end() ? QRectF() : *free);
  }
  return placed;
}

}  // namespace scantrove
