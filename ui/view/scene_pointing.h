#pragma once
#include <QPointF>
#include <QSize>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "ui/common/region_point.h"
#include "ui/scene/label_cloud_scene.h"

namespace scantrove {

/// Finds the region and surface point at a position of the last drawing. Computed when first needed, at about
/// half the widget's resolution; near region borders again in thirds of a pixel. Use from the window's
/// thread.
class ScenePointing {
 public:
  explicit ScenePointing(const LabelCloudScene& scene) : scene_(scene) {}

  /// Call after a new drawing of `pixels`; `ratio`: drawing pixels per widget pixel.
  void setDrawn(const QSize& pixels, double ratio);

  /// CV_32SC1: region by pixel of the last drawing, 0 = none; empty before the first drawing.
  [[nodiscard]] const cv::Mat& regionIds();
  /// `fraction`: position as a fraction of the drawing's width and height, from the top left.
  [[nodiscard]] RegionPoint at(const QPointF& fraction);

 private:
  /// A picture of the scene, or of a part of it.
  struct Picture {
    CloudIds ids;
    cv::Mat regions;  ///< CV_32SC1 of the same size; gaps between points are filled

    [[nodiscard]] RegionPoint at(int x, int y) const;
  };
  void findRegions(Picture& picture) const;
  /// As at(), at a finer resolution than the drawing's pixels.
  [[nodiscard]] RegionPoint atFineScale(const QPointF& fraction);

  const LabelCloudScene& scene_;
  QSize pixels_;
  double ratio_ = 1;
  Picture full_, fine_;
  bool is_outdated_ = false;
};

}  // namespace scantrove
