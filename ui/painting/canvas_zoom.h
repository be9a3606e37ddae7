#pragma once
#include <QPointF>
#include <QRectF>
#include <QSizeF>

namespace scantrove {

/// Where an image lies in a view: in logical pixels of the view, with the image's pixel (0, 0) covering
/// 0 .. 1 in both directions of the image. Fitted at first.
class CanvasZoom {
 public:
  static constexpr double kMaxScale = 64;  ///< pixels of the view for one of the image

  /// Stays fitted if it is; else the middle of the view keeps its place in the image.
  void setSizes(const QSizeF& image, const QSizeF& view);
  void fit();
  /// Multiplies the scale. The place under `at` stays there; within the limits of the scale.
  void zoomAt(const QPointF& at, double factor);
  /// Moves the image; its edge never passes the middle of the view.
  void pan(const QPointF& by);

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] bool isFitted() const { return is_fitted_; }
  [[nodiscard]] QPointF toImage(const QPointF& in_view) const { return (in_view - offset_) / scale_; }
  [[nodiscard]] QPointF toView(const QPointF& in_image) const { return offset_ + scale_ * in_image; }
  /// The image in the view; empty: there is none.
  [[nodiscard]] QRectF imageRect() const;

 private:
  [[nodiscard]] double fittedScale() const;
  void limit();

  QSizeF image_, view_;
  double scale_ = 1;
  QPointF offset_;
  bool is_fitted_ = true;
};

}  // namespace scantrove
