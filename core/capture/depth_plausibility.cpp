#include "core/capture/depth_plausibility.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scantrove {

std::optional<double> medianDepth(const cv::Mat& depth, double meters_per_unit) {
  std::vector<std::uint16_t> valid;
  valid.reserve(depth.total());
  for (int y = 0; y < depth.rows; ++y) {
    const std::uint16_t* const row = depth.ptr<std::uint16_t>(y);
    std::copy_if(row, row + depth.cols, std::back_inserter(valid), [](std::uint16_t d) { return d != 0; });
  }
  if (valid.empty()) {
    return std::nullopt;
  }
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return *middle * meters_per_unit;
}

void warnOfImplausibleDepth(const cv::Mat& depth, double meters_per_unit, const std::string& source_name) {
  constexpr double kNearest_m = 0.2;
  constexpr double kFarthest_m = 8.0;
  const auto median = medianDepth(depth, meters_per_unit);
  if (!median || (*median >= kNearest_m && *median <= kFarthest_m)) {
    return;
  }
  spdlog::warn(
      "{}: the median depth of the first frame is {:.3g} m with {:g} units per metre, which is not plausible "
      "for a room. "
      "Set the right scale with --depth-scale (units per metre: 1000 for millimetres, 5000 for TUM).",
      source_name, *median, 1.0 / meters_per_unit);
}

}  // namespace scantrove
