#include "core/catalogue/view_colors.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check.h"
#include "core/base/soft_bin.h"

namespace scantrove {
namespace {

constexpr float kRange = 66;  // of a and b: surfaces of indoor things are hardly more colourful
/// Pixels that must remain when the outermost are left out; thin things such as pens keep all.
constexpr int kEnoughInner = 40;
/// More pixels, evenly chosen, do not change the shares.
constexpr int kEnoughPixels = 16384;

/// The mask without its outermost pixels, unless too few would remain.
cv::Mat innerPixels(const cv::Mat& mask) {
  cv::Mat whole = mask > 0, inner;
  cv::erode(whole, inner, cv::Mat(), {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return cv::countNonZero(inner) >= kEnoughInner ? inner : whole;
}

/// The chosen pixels in CIELAB, one row.
cv::Mat labOf(const cv::Mat& color, const cv::Mat& chosen, int pixels) {
  const int step = std::max(1, pixels / kEnoughPixels);
  std::vector<cv::Vec3f> bgr;
  int count = 0;
  for (int y = 0; y < color.rows; ++y) {
    const auto* is_chosen = chosen.ptr<std::uint8_t>(y);
    const auto* row = color.ptr<cv::Vec3b>(y);
    for (int x = 0; x < color.cols; ++x) {
      if (is_chosen[x] != 0 && count++ % step == 0) bgr.push_back(cv::Vec3f(row[x]) * (1.0F / 255));
    }
  }
  cv::Mat lab;
  cv::cvtColor(cv::Mat(bgr).reshape(3, 1), lab, cv::COLOR_BGR2Lab);
  return lab;
}

SoftBin binOf(float value, float lowest, float highest, std::size_t bins) {
  return SoftBin::at((value - lowest) / (highest - lowest) * static_cast<float>(bins) - 0.5F, bins);
}

}  // namespace

std::optional<ViewColors> describeColors(const cv::Mat& color, const cv::Mat& mask) {
  if (color.empty() || mask.empty()) return std::nullopt;
  SCANTROVE_CHECK(color.type() == CV_8UC3 && mask.type() == CV_8UC1 && color.size() == mask.size());
  const cv::Mat chosen = innerPixels(mask);
  const int pixels = cv::countNonZero(chosen);
  if (pixels == 0) return std::nullopt;

  constexpr std::size_t kChroma = ViewColors::kChroma;
  const cv::Mat lab = labOf(color, chosen, pixels);
  std::array<double, ViewColors::kBins> sums{};
  for (int i = 0; i < lab.cols; ++i) {
    const auto& value = lab.at<cv::Vec3f>(i);
    const SoftBin l = binOf(value[0], 0, 100, ViewColors::kLightness);
    const SoftBin a = binOf(value[1], -kRange, kRange, kChroma),
                  b = binOf(value[2], -kRange, kRange, kChroma);
    for (std::size_t k = 0; k < 4; ++k) {
      const float weight = (k < 2 ? l.lower : l.upper) * (k % 2 == 0 ? a.lower : a.upper);
      double* row = sums.data() + ((l.bin + k / 2) * kChroma + a.bin + k % 2) * kChroma + b.bin;
      row[0] += static_cast<double>(weight * b.lower);
      row[1] += static_cast<double>(weight * b.upper);
    }
  }
  ViewColors colors;
  std::ranges::transform(sums, colors.roots.begin(), [&](double sum) {
    return static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::min(sum / lab.cols, 1.0))));
  });
  return colors;
}

float colorDistance(const ViewColors& a, const ViewColors& b) {
  int common = 0, all_a = 0, all_b = 0;
  for (std::size_t i = 0; i < ViewColors::kBins; ++i) {
    const int p = a.roots[i], q = b.roots[i];
    common += p * q;
    all_a += p * p;
    all_b += q * q;
  }
  if (all_a == 0 || all_b == 0) return 1;
  // Divides by the true lengths, which rounding has changed.
  const double lengths = std::sqrt(static_cast<double>(all_a) * all_b);
  return static_cast<float>(std::max(1 - common / lengths, 0.0));
}

}  // namespace scantrove
