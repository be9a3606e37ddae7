#include "core/evaluation/nyu2_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kWidth = 960, kHeight = 640;
constexpr int kLeft = 96, kRight = 930, kTop = 40, kBottom = 560;
const cv::Scalar kInk(40, 40, 40), kGridColor(225, 225, 225);
const cv::Scalar kMergedColor(180, 90, 20), kSingleColor(60, 120, 220);  // BGR: blue, orange

/// 1, 2 or 5 times a power of ten: a step with about six marks over `range`.
double roundStep(double range) {
  const double least = std::max(range, 1e-6) / 6;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10 * power;
}

std::string numberText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

void write(cv::Mat& picture, const std::string& text, cv::Point at, double size, const cv::Scalar& color) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
}

void writeCentered(cv::Mat& picture, const std::string& text, cv::Point middle, double size) {
  int below = 0;
  const cv::Size box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &below);
  write(picture, text, {middle.x - box.width / 2, middle.y + box.height / 2}, size, kInk);
}

void drawAxes(cv::Mat& picture, const Nyu2Axes& axes) {
  const double step = roundStep(axes.high - axes.low);
  for (double error = axes.low; error <= axes.high + step / 2; error += step) {
    const cv::Point left = axes.at(axes.first, error);
    cv::line(picture, {kLeft, left.y}, {kRight, left.y}, kGridColor);
    writeCentered(picture, numberText(error), {kLeft - 36, left.y}, 0.5);
  }
  const int every = axes.last - axes.first > 24 ? 5 : 1;
  for (int frames = static_cast<int>(axes.first); frames <= static_cast<int>(axes.last); frames += every) {
    const int x = axes.at(frames, axes.low).x;
    cv::line(picture, {x, kBottom}, {x, kBottom + 6}, kInk);
    writeCentered(picture, std::to_string(frames), {x, kBottom + 22}, 0.5);
  }
  cv::rectangle(picture, {kLeft, kTop}, {kRight, kBottom}, kInk);
  writeCentered(picture, "number of frames", {(kLeft + kRight) / 2, kBottom + 54}, 0.6);
  write(picture, "error 4.1 (pixels)", {kLeft, kTop - 14}, 0.6, kInk);
}

void drawLine(cv::Mat& picture, std::span<const Nyu2Point> curve, const Nyu2Axes& axes,
              Nyu2Error Nyu2Point::*errors, const cv::Scalar& color) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const cv::Point at = axes.at(curve[i].frames, (curve[i].*errors).all);
    if (i > 0) {
      const cv::Point before = axes.at(curve[i - 1].frames, (curve[i - 1].*errors).all);
      cv::line(picture, before, at, color, 2, cv::LINE_AA);
    }
    cv::circle(picture, at, 4, color, cv::FILLED, cv::LINE_AA);
  }
}

void drawLegend(cv::Mat& picture, int images) {
  const auto entry = [&](int row, const cv::Scalar& color, const std::string& text) {
    const int y = kTop + 26 + 26 * row;
    cv::line(picture, {kRight - 330, y}, {kRight - 296, y}, color, 2, cv::LINE_AA);
    write(picture, text, {kRight - 284, y + 5}, 0.5, kInk);
  };
  entry(0, kMergedColor, "merged over the frames");
  entry(1, kSingleColor, "last frame alone, same surface");
  write(picture, std::to_string(images) + (images == 1 ? " image" : " images"), {kRight - 284, kTop + 83},
        0.5, kInk);
}

}  // namespace

cv::Point Nyu2Axes::at(double frames, double error) const {
  const double x = last > first ? (frames - first) / (last - first) : 0.5;
  const double y = high > low ? (error - low) / (high - low) : 0.5;
  return {static_cast<int>(std::lround(kLeft + x * (kRight - kLeft))),
          static_cast<int>(std::lround(kBottom - y * (kBottom - kTop)))};
}

Nyu2Axes nyu2Axes(std::span<const Nyu2Point> curve) {
  SCANTROVE_CHECK(!curve.empty());
  Nyu2Axes axes{static_cast<double>(curve.front().frames), static_cast<double>(curve.back().frames),
                curve.front().merged.all, curve.front().merged.all};
  for (const Nyu2Point& point : curve) {
    for (const double error : {point.merged.all, point.single.all}) {
      axes.low = std::min(axes.low, error);
      axes.high = std::max(axes.high, error);
    }
  }
  const double step = roundStep(axes.high - axes.low);
  axes.low = std::max(0.0, std::floor(axes.low / step) * step);
  axes.high = std::max(std::ceil(axes.high / step) * step, axes.low + step);
  return axes;
}

cv::Mat drawNyu2Curve(std::span<const Nyu2Point> curve) {
  const Nyu2Axes axes = nyu2Axes(curve);
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255));
  drawAxes(picture, axes);
  drawLine(picture, curve, axes, &Nyu2Point::single, kSingleColor);
  drawLine(picture, curve, axes, &Nyu2Point::merged, kMergedColor);
  drawLegend(picture, curve.front().images);
  return picture;
}

}  // namespace scantrove
