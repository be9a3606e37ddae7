#pragma once
#include <QImage>
#include <QPointF>
#include <QRect>
#include <QString>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// How masks are drawn over an image.
enum class MaskStyle { fill, outline, none };

/// The regions (CV_32SC1) in their colours, transparent where there is none; as outlines, only pixels beside
/// another region. Null without masks.
[[nodiscard]] QImage maskPicture(const cv::Mat& regions, MaskStyle style);

/// A transparent picture for paintDraft().
[[nodiscard]] QImage emptyDraft(const QSize& size);
/// Draws a part of a draft (CV_8UC1 of the picture's size) in a colour; the rest of that part is transparent.
void paintDraft(QImage& picture, const cv::Mat& draft, const QRect& part, const QColor& color);

/// A name and the pixel where it stands, which shows its region.
struct MaskName {
  QPointF at;
  QString text;
};
/// Names of the regions that are large enough in the image. `name_of`: empty for a region without one.
[[nodiscard]] std::vector<MaskName> maskNames(const cv::Mat& regions,
                                              const std::function<QString(RegionId)>& name_of);

}  // namespace scantrove
