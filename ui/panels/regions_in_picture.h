#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <set>

#include "core/base/ids.h"

namespace scantrove {

/// A visible region in a picture of ids.
struct RegionInPicture {
  cv::Point anchor_px;  ///< its pixel that is nearest to the centre of its visible part
  cv::Rect box_px;      ///< around its visible part
  int pixels = 0;
};

/// Where names belong in a picture. `ids`: CV_32SC1, the region by pixel. Regions with fewer than `least`
/// pixels are left out.
[[nodiscard]] std::map<RegionId, RegionInPicture> regionsInPicture(const cv::Mat& ids,
                                                                   const std::set<RegionId>& regions,
                                                                   int least);

}  // namespace scantrove
