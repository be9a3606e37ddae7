#include "core/capture/depth_plausibility.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace scantrove {
namespace {

constexpr double kNearestMedian_m = 0.2, kFarthestMedian_m = 8;
/// The middle of rooms and table tops in the sample recordings; scales are compared by it.
constexpr double kUsualMedian_m = 1.8;
/// Millimetres, TUM, tenths of a millimetre, metres, centimetres.
constexpr std::array<double, 5> kUsualScales{1000, 5000, 10000, 1, 100};

bool isPlausibleMedian(double median_m) {
  return median_m >= kNearestMedian_m && median_m <= kFarthestMedian_m;
}

template <class T>
std::optional<double> medianOf(const cv::Mat& depth) {
  std::vector<T> valid;
  valid.reserve(depth.total());
  for (int y = 0; y < depth.rows; ++y) {
    const T* const row = depth.ptr<T>(y);
    std::copy_if(row, row + depth.cols, std::back_inserter(valid), [](T d) { return d > 0; });
  }
  if (valid.empty()) return std::nullopt;
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return static_cast<double>(*middle);
}

std::optional<double> proposedScale(double median_units) {
  std::optional<double> best;
  const auto distance = [&](double scale) {
    return std::abs(std::log(median_units / scale / kUsualMedian_m));
  };
  for (const double scale : kUsualScales) {
    if (!isPlausibleMedian(median_units / scale)) continue;
    if (!best || distance(scale) < distance(*best)) best = scale;
  }
  return best;
}

}  // namespace

std::optional<double> medianDepth(const cv::Mat& depth, double meters_per_unit) {
  const auto median = depth.type() == CV_32FC1 ? medianOf<float>(depth) : medianOf<std::uint16_t>(depth);
  return median ? std::optional(*median * meters_per_unit) : std::nullopt;
}

double ImplausibleDepth::proposedMedian_m() const {
  return median_m * units_per_meter / proposed_units_per_meter.value_or(units_per_meter);
}

std::optional<ImplausibleDepth> judgeDepth(const cv::Mat& depth, double units_per_meter) {
  const auto median_units = medianDepth(depth, 1);
  if (!median_units || isPlausibleMedian(*median_units / units_per_meter)) return std::nullopt;
  return ImplausibleDepth{units_per_meter, *median_units / units_per_meter, proposedScale(*median_units)};
}

Error describe(const ImplausibleDepth& implausible, const std::string& source_name) {
  Error error;
  error.what = fmt::format(
      "{}: the median depth of the first frame is {:.3g} m with {:g} units per metre, which is not plausible "
      "for a room.",
      source_name, implausible.median_m, implausible.units_per_meter);
  if (implausible.proposed_units_per_meter) {
    error.advice =
        fmt::format("{0:g} units per metre would make the median {1:.2g} m: give --depth-scale {0:g}.",
                    *implausible.proposed_units_per_meter, implausible.proposedMedian_m());
  } else {
    error.advice =
        "Set the right scale with --depth-scale (units per metre: 1000 for millimetres, 5000 for TUM).";
  }
  return error;
}

std::optional<ImplausibleDepth> warnOfImplausibleDepth(const cv::Mat& depth, double units_per_meter,
                                                       const std::string& source_name) {
  const auto implausible = judgeDepth(depth, units_per_meter);
  if (implausible) spdlog::warn("{}", describe(*implausible, source_name).message());
  return implausible;
}

}  // namespace scantrove
