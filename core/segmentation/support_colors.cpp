#include "core/segmentation/support_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace scantrove {
namespace {

constexpr int kCell_px = 8;  // colours of the support are averaged in cells
/// Cells to each side over which the support's colour is averaged: first far, so that an object does not
/// dominate; then near, without the pixels that differ, so that the colour follows the light.
constexpr int kFarCells = 10, kNearCells = 4;
constexpr int kColorStride = 2;   // pixels that are averaged
constexpr float kMinPixels = 10;  // in strides: fewer do not tell the support's colour
constexpr float kOutlier = 2.5F;  // difference from which a pixel is not of the support
/// Least variation: light varies over a table in L*; sensors and compression in a* and b*.
const cv::Vec3f kMinDeviation{4.5F, 1.8F, 1.8F};
/// Light on a support falls to this part of the mean, and its chroma in proportion ...
constexpr float kShade = 0.88F;
/// ... and in a shadow to this one.
constexpr float kShadow = 0.5F;
/// A highlight goes this part of the way to white.
constexpr float kGloss = 0.25F;
constexpr float kWhite = 100;  // L*

struct ColorModel {
  cv::Vec3f mean, deviation;

  /// The difference of `pixel` from this colour, in deviations, if its light explains as much as may be:
  /// shade scales lightness and chroma, down to the part `shadow`; gloss adds white.
  [[nodiscard]] float difference(const cv::Vec3f& pixel, float shadow) const {
    const float lightness = std::max(mean[0], 1.0F);
    cv::Vec3f expected = mean;
    if (pixel[0] <= lightness) {
      expected *= std::max(pixel[0] / lightness, shadow);
    } else {
      const cv::Vec3f to_white(kWhite - lightness, -mean[1], -mean[2]);
      const float gloss = (pixel - mean).dot(to_white) / std::max(to_white.dot(to_white), 1.0F);
      expected += std::clamp(gloss, 0.0F, kGloss) * to_white;
    }
    const float l = (pixel[0] - expected[0]) / deviation[0], a = (pixel[1] - expected[1]) / deviation[1],
                b = (pixel[2] - expected[2]) / deviation[2];
    return std::sqrt(l * l + a * a + b * b);
  }
};

/// Colour models by cell.
struct CellModels {
  cv::Mat3f mean, deviation;
};

/// Medians over the whole support: objects on it have little influence.
ColorModel modelOfAll(const cv::Mat3f& lab, const cv::Mat1b& flat) {
  ColorModel model;
  std::vector<float> values;
  const auto median = [&] {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  for (int channel = 0; channel < 3; ++channel) {
    constexpr int kSparse = 4;  // pixels
    values.clear();
    for (int v = 0; v < flat.rows; v += kSparse) {
      for (int u = 0; u < flat.cols; u += kSparse)
        if (flat(v, u) != 0) values.push_back(lab(v, u)[channel]);
    }
    if (values.empty()) values.push_back(0);
    model.mean[channel] = median();
    for (float& value : values) value = std::abs(value - model.mean[channel]);
    constexpr float kDeviationOfMedian = 1.4826F;  // of a normal distribution
    model.deviation[channel] = std::max(kDeviationOfMedian * median(), kMinDeviation[channel]);
  }
  return model;
}

cv::Size cellsOf(const cv::Size& image) {
  return {(image.width + kCell_px - 1) / kCell_px, (image.height + kCell_px - 1) / kCell_px};
}

/// Values of cells at the pixels of an image, which they may exceed.
cv::Mat3f atPixels(const cv::Mat3f& cells) {
  cv::Mat3f pixels;
  cv::resize(cells, pixels, cells.size() * kCell_px, 0, 0, cv::INTER_LINEAR);
  return pixels;
}

/// Calls `visit` with every second pixel (u, v) in both directions and its cell (x, y); rows of cells at the
/// same time.
template <class Visit>
void forSampledPixels(const cv::Size& image, const Visit& visit) {
  static_assert(kCell_px % kColorStride == 0);
  cv::parallel_for_({0, cellsOf(image).height}, [&](const cv::Range& rows) {
    for (int v = rows.start * kCell_px; v < std::min(rows.end * kCell_px, image.height); v += kColorStride)
      for (int u = 0; u < image.width; u += kColorStride) visit(u, v, u / kCell_px, v / kCell_px);
  });
}

/// Sums over a window of cells around each cell.
void sumAround(int reach_cells, cv::Mat image) {
  const int side = 2 * reach_cells + 1;
  cv::boxFilter(image, image, CV_32F, {side, side}, {-1, -1}, false, cv::BORDER_CONSTANT);
}

/// Models around each cell, from the support's pixels that differ little from `before(x, y)`, the model of a
/// cell so far. Cells with few such pixels around keep that model.
template <class Before>
CellModels modelsAround(const cv::Mat3f& lab, const cv::Mat1b& flat, int reach_cells, const Before& before) {
  const cv::Size cells = cellsOf(lab.size());
  cv::Mat1b used(lab.size(), 0);
  cv::Mat1f count(cells, 0.0F);
  cv::Mat3f sum(cells, cv::Vec3f()), squares(cells, cv::Vec3f());
  forSampledPixels(lab.size(), [&](int u, int v, int x, int y) {
    if (flat(v, u) == 0 || before(x, y).difference(lab(v, u), kShade) > kOutlier) return;
    used(v, u) = 255;
    count(y, x) += 1;
    sum(y, x) += lab(v, u);
  });
  sumAround(reach_cells, count);
  sumAround(reach_cells, sum);
  CellModels models{cv::Mat3f(cells), cv::Mat3f(cells)};
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x)
      models.mean(y, x) = count(y, x) >= kMinPixels ? sum(y, x) / count(y, x) : before(x, y).mean;
  }
  const cv::Mat3f mean = atPixels(models.mean);
  forSampledPixels(lab.size(), [&](int u, int v, int x, int y) {
    if (used(v, u) == 0) return;
    const cv::Vec3f off = lab(v, u) - mean(v, u);
    squares(y, x) += off.mul(off);
  });
  sumAround(reach_cells, squares);
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      models.deviation(y, x) = before(x, y).deviation;
      if (count(y, x) < kMinPixels) continue;
      for (int channel = 0; channel < 3; ++channel)
        models.deviation(y, x)[channel] =
            std::max(std::sqrt(squares(y, x)[channel] / count(y, x)), kMinDeviation[channel]);
    }
  }
  return models;
}

}  // namespace

SupportColorDifference differenceFromSupport(const cv::Mat3f& lab, const cv::Mat1b& flat,
                                             const cv::Mat1b& area) {
  SupportColorDifference result{{flat.size(), 0.0F}, {flat.size(), 0.0F}};
  if (lab.empty()) return result;
  const ColorModel all = modelOfAll(lab, flat);
  const CellModels wide =
      modelsAround(lab, flat, kFarCells, [&](int, int) -> const ColorModel& { return all; });
  const CellModels near = modelsAround(lab, flat, kNearCells, [&](int x, int y) {
    return ColorModel{wide.mean(y, x), wide.deviation(y, x)};
  });
  const cv::Mat3f mean = atPixels(near.mean), deviation = atPixels(near.deviation);
  const auto compare = [&](int u, int v) {
    if (area(v, u) == 0) return;
    const ColorModel model{mean(v, u), deviation(v, u)};
    const float lit = model.difference(lab(v, u), kShade);
    result.lit(v, u) = lit;
    result.shaded(v, u) =
        lit < kClearColorDifference ? lit : std::min(lit, model.difference(lab(v, u), kShadow));
  };
  cv::parallel_for_({0, lab.rows}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v)
      for (int u = 0; u < lab.cols; ++u) compare(u, v);
  });
  return result;
}

}  // namespace scantrove
