#pragma once
#include <QPointF>
#include <QSize>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "ui/common/region_point.h"
#include "ui/scene/label_cloud_scene.h"

namespace scantrove {

/// Which region, and which point of its surface, the last drawing of the scene shows where. Found when it is
/// asked for first, at about half the resolution of the widget; near where regions meet, anew in thirds of
/// its pixels. One thread, the window's.
class ScenePointing {
 public:
  explicit ScenePointing(const LabelCloudScene& scene) : scene_(scene) {}

  /// There is a new drawing of `pixels`; the screen has `ratio` of them a pixel of the widget.
  void setDrawn(const QSize& pixels, double ratio);

  /// CV_32SC1: the region in each pixel of the last drawing, 0 = none; empty: nothing was drawn yet.
  [[nodiscard]] const cv::Mat& regionIds();
  /// `fraction`: of the drawing's width and height, from the top left.
  [[nodiscard]] RegionPoint at(const QPointF& fraction);

 private:
  /// A picture of the scene, or of a part of it.
  struct Picture {
    CloudIds ids;
    cv::Mat regions;  ///< CV_32SC1, as large; gaps between points are closed

    [[nodiscard]] RegionPoint at(int x, int y) const;
  };
  void findRegions(Picture& picture) const;
  /// What is there, seen more closely than the drawing has pixels. `fraction`: as above.
  [[nodiscard]] RegionPoint closely(const QPointF& fraction);

  const LabelCloudScene& scene_;
  QSize pixels_;
  double ratio_ = 1;
  Picture whole_, close_;
  bool is_old_ = false;
};

}  // namespace scantrove
