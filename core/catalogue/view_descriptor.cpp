#include "core/catalogue/view_descriptor.h"

namespace scantrove {

std::optional<ViewDescriptor> describeView(const cv::Mat& color, const cv::Mat& mask) {
  const std::optional<Thumbnail> thumbnail = makeThumbnail(color, mask);
  if (!thumbnail) return std::nullopt;
  return ViewDescriptor{*thumbnail, describeColors(color, mask), {}};
}

}  // namespace scantrove
