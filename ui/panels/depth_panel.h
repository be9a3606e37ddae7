#pragma once
#include "ui/panels/image_conversion.h"
#include "ui/panels/image_panel.h"

namespace scantrove {

/// A depth image in colours, with a legend in metres.
class DepthPanel : public ImagePanel {
  Q_OBJECT

 public:
  using ImagePanel::ImagePanel;
  void setDepth(const cv::Mat& depth_m, const DepthRange& range);

 protected:
  void paintOverlay(QPainter& painter, const QRectF& rect) override;

 private:
  DepthRange range_;
};

}  // namespace scantrove
