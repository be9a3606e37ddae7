#include "core/editing/magic_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

/// Wider bands are decided at half the size first, then in a narrow band at full size.
constexpr int kDirect_px = 4, kNarrow_px = 3;
/// Part of a thin mask's half width that may move, so that its middle stays.
constexpr float kThinPart = 0.6F;
/// Squared steps of colour (L, a, b of 0 .. 255) that count as noise.
constexpr float kNoiseStep2 = 30;
/// Cost of cutting across the strongest edge, relative to plain surface.
constexpr float kLeastCapacity = 0.02F;
/// Edges that a pixel of an outline cuts: one straight and two slanting ones.
constexpr float kPerEdge = 1 / (1 + 1.41421356F);
/// Cost of giving a pixel to the side whose colour it has not.
constexpr float kSideLeaning = 0.4F;
/// Cost of moving an outline through the whole band over plain surface, relative to cutting that surface.
constexpr float kStaying = 1;
/// Window of the colours nearby, relative to the reach.
constexpr int kWindow = 4;

enum PixelSide : std::uint8_t { kInside = 0, kOutside = 1, kUndecided = 2 };

cv::Mat distancesWithin(const cv::Mat& mask) {
  cv::Mat distances;
  cv::distanceTransform(mask, distances, cv::DIST_L2, cv::DIST_MASK_5);
  return distances;
}

/// The sides of decided pixels; CV_8UC1.
cv::Mat bandOf(const cv::Mat& rough, int reach_px) {
  const auto reach = static_cast<float>(reach_px);
  const cv::Mat to_outside = distancesWithin(rough), to_inside = distancesWithin(rough == 0);
  cv::Mat labels;
  const int count = cv::connectedComponents(rough, labels, 8, CV_32S);
  std::vector<float> half_widths(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < rough.rows; ++y) {
    for (int x = 0; x < rough.cols; ++x) {
      float& half = half_widths[static_cast<std::size_t>(labels.at<int>(y, x))];
      half = std::max(half, to_outside.at<float>(y, x));
    }
  }
  cv::Mat side(rough.size(), CV_8UC1);
  for (int y = 0; y < rough.rows; ++y) {
    for (int x = 0; x < rough.cols; ++x) {
      auto& of_pixel = side.at<std::uint8_t>(y, x);
      if (rough.at<std::uint8_t>(y, x) == 0) {
        of_pixel = to_inside.at<float>(y, x) > reach ? kOutside : kUndecided;
      } else {
        const float half = half_widths[static_cast<std::size_t>(labels.at<int>(y, x))];
        of_pixel = to_outside.at<float>(y, x) > std::min(reach, kThinPart * half) ? kInside : kUndecided;
      }
    }
  }
  return side;
}

/// The colours of one side in windows, at a reduced size.
class SideColors {
 public:
  SideColors(const cv::Mat& lab, const cv::Mat& of_side, int radius_px)
      : shrink_(radius_px > 2 * kShrink ? kShrink : 1) {
    const cv::Size small((lab.cols + shrink_ - 1) / shrink_, (lab.rows + shrink_ - 1) / shrink_);
    const int radius = std::max(1, radius_px / shrink_);
    const cv::Size window(2 * radius + 1, 2 * radius + 1);
    cv::Mat colors, weight, weights, squares;
    cv::resize(lab, colors, small, 0, 0, cv::INTER_NEAREST);
    cv::resize(of_side, weight, small, 0, 0, cv::INTER_NEAREST);
    weight.convertTo(weight, CV_32F, 1.0 / 255);
    cv::merge(std::array{weight, weight, weight}, weights);
    cv::multiply(colors, weights, weights);
    cv::multiply(colors, weights, squares);
    const auto sumOf = [&](const cv::Mat& image, cv::Mat& sums) {
      cv::boxFilter(image, sums, CV_32F, window, {-1, -1}, false, cv::BORDER_CONSTANT);
    };
    sumOf(weights, sums_);
    sumOf(squares, sums2_);
    sumOf(weight, counts_);
  }

  /// Distance of a colour from those nearby, in squared standard deviations; negative: the side is not near.
  [[nodiscard]] float distance(const cv::Point& pixel, const cv::Vec3f& color) const {
    const cv::Point at(pixel.x / shrink_, pixel.y / shrink_);
    const float count = counts_.at<float>(at);
    if (count < 0.5F) return -1;
    const cv::Vec3f &sum = sums_.at<cv::Vec3f>(at), &sum2 = sums2_.at<cv::Vec3f>(at);
    float variance = 0, difference2 = 0;
    for (int c = 0; c < 3; ++c) {
      const float mean = sum[c] / count, step = color[c] - mean;
      variance += std::max(0.0F, sum2[c] / count - mean * mean);
      difference2 += step * step;
    }
    return difference2 / (variance + kNoiseStep2);
  }

 private:
  static constexpr int kShrink = 4;
  int shrink_;
  cv::Mat sums_, sums2_, counts_;
};

/// Decides the open pixels of `side` by a minimum cut.
class BandCut {
 public:
  BandCut(const cv::Mat& lab, const cv::Mat& rough, int reach_px, cv::Mat& side)
      : lab_(lab), side_(side), vertices_(side.size(), CV_32SC1, cv::Scalar::all(-1)) {
    const int open_pixels = cv::countNonZero(side == kUndecided);
    flow_.create(static_cast<unsigned>(open_pixels) + 2, 4 * static_cast<unsigned>(open_pixels) + 2);
    const int first = flow_.addVtx();
    flow_.addEdges(first, flow_.addVtx(), 0, 0);  // GCGraph needs an edge, even if no open pixels touch
    addVertices(rough, reach_px);
    scale_ = 0.5F / std::max(meanStep2(), kNoiseStep2);
    forEachStep([&](const cv::Point& a, const cv::Point& b, float length) { link(a, b, length); });
  }

  void run() {
    flow_.maxFlow();
    for (int y = 0; y < side_.rows; ++y) {
      for (int x = 0; x < side_.cols; ++x) {
        const int vertex = vertices_.at<int>(y, x);
        if (vertex >= 0) side_.at<std::uint8_t>(y, x) = flow_.inSourceSegment(vertex) ? kInside : kOutside;
      }
    }
  }

 private:
  void addVertices(const cv::Mat& rough, int reach_px) {
    const SideColors insides(lab_, side_ == kInside, kWindow * reach_px);
    const SideColors outsides(lab_, side_ == kOutside, kWindow * reach_px);
    const float stay = kStaying / static_cast<float>(reach_px);
    for (int y = 0; y < side_.rows; ++y) {
      for (int x = 0; x < side_.cols; ++x) {
        if (side_.at<std::uint8_t>(y, x) != kUndecided) continue;
        const int vertex = vertices_.at<int>(y, x) = flow_.addVtx();
        const auto& color = lab_.at<cv::Vec3f>(y, x);
        const float in = insides.distance({x, y}, color), out = outsides.distance({x, y}, color);
        const float leaning = in < 0 || out < 0 ? 0 : std::clamp((out - in) / 4, -1.0F, 1.0F);
        const bool was_inside = rough.at<std::uint8_t>(y, x) != 0;
        flow_.addTermWeights(vertex, kSideLeaning * std::max(leaning, 0.0F) + (was_inside ? stay : 0),
                             kSideLeaning * std::max(-leaning, 0.0F) + (was_inside ? 0 : stay));
      }
    }
  }

  /// Calls use(a, b, length) for all neighbours of which one is open.
  template <class Use>
  void forEachStep(Use&& use) const {
    static constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};
    for (int y = 0; y < side_.rows; ++y) {
      for (int x = 0; x < side_.cols; ++x) {
        for (const auto& [dx, dy] : kSteps) {
          const int u = x + dx, v = y + dy;
          if (u < 0 || u >= side_.cols || v >= side_.rows) continue;
          const bool is_any =
              side_.at<std::uint8_t>(y, x) == kUndecided || side_.at<std::uint8_t>(v, u) == kUndecided;
          if (is_any) use(cv::Point(x, y), cv::Point(u, v), dx != 0 && dy != 0 ? std::sqrt(2.0F) : 1.0F);
        }
      }
    }
  }
  [[nodiscard]] float step2(const cv::Point& a, const cv::Point& b) const {
    const cv::Vec3f step = lab_.at<cv::Vec3f>(a) - lab_.at<cv::Vec3f>(b);
    return step.dot(step);
  }
  [[nodiscard]] float meanStep2() const {
    double sum = 0, count = 0;
    forEachStep([&](const cv::Point& a, const cv::Point& b, float) {
      sum += step2(a, b);
      ++count;
    });
    return count > 0 ? static_cast<float>(sum / count) : 0;
  }
  void link(const cv::Point& a, const cv::Point& b, float length) {
    const float capacity = kPerEdge * (std::exp(-scale_ * step2(a, b)) + kLeastCapacity) / length;
    const int of_a = vertices_.at<int>(a), of_b = vertices_.at<int>(b);
    if (of_a >= 0 && of_b >= 0) {
      flow_.addEdges(of_a, of_b, capacity, capacity);
    } else {
      const bool is_inside = side_.at<std::uint8_t>(of_a >= 0 ? b : a) == kInside;
      flow_.addTermWeights(std::max(of_a, of_b), is_inside ? capacity : 0, is_inside ? 0 : capacity);
    }
  }

  const cv::Mat& lab_;
  cv::Mat& side_;
  cv::Mat vertices_;
  float scale_ = 0;
  cv::detail::GCGraph<float> flow_;
};

/// `color` and `rough` (0 or 255): crops of the image; 255 = inside.
cv::Mat snapDirectly(const cv::Mat& color, const cv::Mat& rough, int reach_px) {
  cv::Mat side = bandOf(rough, reach_px);
  const bool has_both = cv::countNonZero(side == kInside) > 0 && cv::countNonZero(side == kOutside) > 0;
  if (!has_both) return rough;
  cv::Mat smooth, lab;
  cv::GaussianBlur(color, smooth, {3, 3}, 0);
  cv::cvtColor(smooth, lab, cv::COLOR_BGR2Lab);
  lab.convertTo(lab, CV_32F);
  BandCut(lab, rough, reach_px, side).run();
  return side == kInside;
}

cv::Mat snapCrop(const cv::Mat& color, const cv::Mat& rough, int reach_px) {
  if (reach_px <= kDirect_px || std::min(rough.cols, rough.rows) < 8 * kDirect_px)
    return snapDirectly(color, rough, reach_px);
  cv::Mat half_color, half_rough, wide;
  cv::resize(color, half_color, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::resize(rough, half_rough, half_color.size(), 0, 0, cv::INTER_AREA);
  const cv::Mat coarse = snapCrop(half_color, half_rough >= 128, (reach_px + 1) / 2);
  if (cv::countNonZero(coarse) == 0) return snapDirectly(color, rough, reach_px);
  cv::resize(coarse, wide, rough.size(), 0, 0, cv::INTER_LINEAR);
  return snapDirectly(color, wide >= 128, kNarrow_px);
}

}  // namespace

SnappedMask snapToEdges(const cv::Mat& color, const cv::Mat& rough, int reach_px) {
  SCANTROVE_CHECK(color.type() == CV_8UC3 && rough.type() == CV_8UC1 && color.size() == rough.size());
  const cv::Rect image({}, rough.size());
  cv::Rect box = cv::boundingRect(rough);
  if (box.empty() || reach_px < 1) return {};
  const int reach = std::min(reach_px, std::max(image.width, image.height));
  const int margin = 2 * reach + 2;
  const cv::Rect around = (box + cv::Size(2 * margin, 2 * margin) - cv::Point(margin, margin)) & image;
  const cv::Mat snapped = snapCrop(color(around), rough(around) != 0, reach);
  box = (box + cv::Size(2 * reach, 2 * reach) - cv::Point(reach, reach)) & image;
  return {box, snapped(box - around.tl()).clone()};
}

}  // namespace scantrove
