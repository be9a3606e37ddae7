#include "ui/painting/canvas_zoom.h"

#include <algorithm>

namespace scantrove {

void CanvasZoom::setSizes(const QSizeF& image, const QSizeF& view) {
  if (image == image_ && view == view_) return;
  const bool is_other_image = image != image_;
  const QPointF middle = toImage({view_.width() / 2, view_.height() / 2});
  image_ = image;
  view_ = view;
  if (is_fitted_ || is_other_image) return fit();
  offset_ = QPointF(view_.width() / 2, view_.height() / 2) - scale_ * middle;
  limit();
}

double CanvasZoom::fittedScale() const {
  if (image_.isEmpty() || view_.isEmpty()) return 1;
  return std::min(view_.width() / image_.width(), view_.height() / image_.height());
}

void CanvasZoom::fit() {
  is_fitted_ = true;
  scale_ = fittedScale();
  offset_ = {(view_.width() - scale_ * image_.width()) / 2, (view_.height() - scale_ * image_.height()) / 2};
}

void CanvasZoom::zoomAt(const QPointF& at, double factor) {
  const double least = fittedScale();
  const double scale = std::clamp(scale_ * factor, least, std::max(least, kMaxScale));
  if (scale <= least) return fit();
  const QPointF kept = toImage(at);
  is_fitted_ = false;
  scale_ = scale;
  offset_ = at - scale_ * kept;
  limit();
}

void CanvasZoom::pan(const QPointF& by) {
  if (is_fitted_) return;
  offset_ += by;
  limit();
}

void CanvasZoom::limit() {
  const QPointF middle(view_.width() / 2, view_.height() / 2);
  offset_.setX(std::clamp(offset_.x(), middle.x() - scale_ * image_.width(), middle.x()));
  offset_.setY(std::clamp(offset_.y(), middle.y() - scale_ * image_.height(), middle.y()));
}

QRectF CanvasZoom::imageRect() const { return {offset_, scale_ * image_}; }

}  // namespace scantrove
