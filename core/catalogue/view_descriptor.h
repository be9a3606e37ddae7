#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/catalogue/thumbnail.h"
#include "core/catalogue/view_colors.h"

namespace scantrove {

/// What a network (AppearanceNetwork) says of a view.
struct NetworkVector {
  std::string network;        ///< AppearanceNetwork::hash(); only vectors of one network are comparable
  std::vector<float> values;  ///< of length 1
};

/// What recognition compares of one view.
struct ViewDescriptor {
  Thumbnail thumbnail;
  std::optional<ViewColors> colors = {};      ///< none: an older version stored the view, its images are lost
  std::optional<NetworkVector> network = {};  ///< none: no network was chosen when the view was stored
};

/// Without a network. `color` (CV_8UC3 BGR) and `mask` (CV_8UC1) share any size. None: no colour or no
/// object pixel.
[[nodiscard]] std::optional<ViewDescriptor> describeView(const cv::Mat& color, const cv::Mat& mask);

}  // namespace scantrove
