#include "core/editing/mask_tools.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"

namespace scantrove {
namespace {

/// Points farther away than this paint nothing else than points at this distance, in any image.
constexpr float kFarthest_px = 1e6F;

std::uint8_t valueOf(PaintMode mode) { return mode == PaintMode::add ? 255 : 0; }

std::vector<cv::Point2f> usable(std::span<const cv::Point2f> points) {
  std::vector<cv::Point2f> list;
  for (const cv::Point2f& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    list.emplace_back(std::clamp(point.x, -kFarthest_px, kFarthest_px),
                      std::clamp(point.y, -kFarthest_px, kFarthest_px));
  }
  return list;
}

/// Part of a row, both ends included; empty: first > last.
struct Span {
  int first = 0, last = -1;
};

/// The pixels within a radius of a line segment. Each row of them is one span, because they are convex.
class Capsule {
 public:
  Capsule(const cv::Point2f& a, const cv::Point2f& b, float radius) : a_(a), b_(b), radius_(radius) {}

  [[nodiscard]] cv::Rect box(const cv::Size& size) const {
    const int left = cvFloor(std::min(a_.x, b_.x) - radius_), right = cvCeil(std::max(a_.x, b_.x) + radius_);
    const int top = cvFloor(std::min(a_.y, b_.y) - radius_), bottom = cvCeil(std::max(a_.y, b_.y) + radius_);
    return cv::Rect(cv::Point(left, top), cv::Point(right + 1, bottom + 1)) & cv::Rect({}, size);
  }
  /// Of the pixels first .. last of a row.
  [[nodiscard]] Span inRow(int y, int first, int last) const {
    // The span holds the pixel of the row that is nearest to the line, if any.
    const int middle = nearestInRow(y, first, last);
    if (!holds(middle, y)) return {};
    return {edge(y, middle, first), edge(y, middle, last)};
  }

 private:
  [[nodiscard]] double squaredDistance(double x, double y) const {
    const double dx = double{b_.x} - a_.x, dy = double{b_.y} - a_.y;
    const double length2 = dx * dx + dy * dy;
    const double along =
        length2 > 0 ? std::clamp(((x - a_.x) * dx + (y - a_.y) * dy) / length2, 0.0, 1.0) : 0;
    const double ex = x - (a_.x + along * dx), ey = y - (a_.y + along * dy);
    return ex * ex + ey * ey;
  }
  [[nodiscard]] bool holds(int x, int y) const { return squaredDistance(x, y) <= double{radius_} * radius_; }
  /// The distance along a row is convex: a ternary search finds its least pixel.
  [[nodiscard]] int nearestInRow(int y, int first, int last) const {
    while (last - first > 2) {
      const int third = (last - first) / 3;
      const int a = first + third, b = last - third;
      if (squaredDistance(a, y) <= squaredDistance(b, y)) {
        last = b;
      } else {
        first = a;
      }
    }
    int nearest = first;
    for (int x = first + 1; x <= last; ++x) {
      if (squaredDistance(x, y) < squaredDistance(nearest, y)) nearest = x;
    }
    return nearest;
  }
  /// The outermost pixel from `inside` towards `end` that is held.
  [[nodiscard]] int edge(int y, int inside, int end) const {
    if (holds(end, y)) return end;
    while (std::abs(end - inside) > 1) {
      const int middle = inside + (end - inside) / 2;
      (holds(middle, y) ? inside : end) = middle;
    }
    return inside;
  }

  cv::Point2f a_, b_;
  float radius_;
};

/// Adds where an outline crosses the rows, from `first_row` on, to `crossings`.
void addCrossings(std::span<const cv::Point2f> outline, int first_row,
                  std::vector<std::vector<double>>& crossings) {
  const int last_row = first_row + static_cast<int>(crossings.size()) - 1;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const cv::Point2f& p = outline[i];
    const cv::Point2f& q = outline[(i + 1) % outline.size()];
    if (p.y == q.y) continue;
    const cv::Point2f &low = p.y < q.y ? p : q, &high = p.y < q.y ? q : p;
    // The upper end belongs to the next edge.
    const int from = std::max(cvCeil(low.y), first_row), to = std::min(cvCeil(high.y) - 1, last_row);
    for (int y = from; y <= to; ++y) {
      const double share = (y - double{low.y}) / (double{high.y} - low.y);
      crossings[static_cast<std::size_t>(y - first_row)].push_back(low.x + share * (double{high.x} - low.x));
    }
  }
}

}  // namespace

cv::Rect paintStroke(cv::Mat& mask, std::span<const cv::Point2f> points, float radius_px, PaintMode mode) {
  SCANTROVE_CHECK(mask.type() == CV_8UC1);
  const std::vector<cv::Point2f> line = usable(points);
  cv::Rect touched;
  if (line.empty() || !(radius_px >= 0)) return touched;
  const float radius = std::min(radius_px, kFarthest_px);
  for (std::size_t i = 0; i < std::max<std::size_t>(line.size() - 1, 1); ++i) {
    const Capsule capsule(line[i], line[std::min(i + 1, line.size() - 1)], radius);
    const cv::Rect box = capsule.box(mask.size());
    if (box.empty()) continue;
    for (int y = box.y; y < box.br().y; ++y) {
      const Span span = capsule.inRow(y, box.x, box.br().x - 1);
      auto* row = mask.ptr(y);
      if (span.first <= span.last) std::fill(row + span.first, row + span.last + 1, valueOf(mode));
    }
    touched |= box;
  }
  return touched;
}

cv::Rect paintPolygon(cv::Mat& mask, std::span<const std::vector<cv::Point2f>> outlines, PaintMode mode) {
  SCANTROVE_CHECK(mask.type() == CV_8UC1);
  std::vector<std::vector<cv::Point2f>> closed;
  float left = kFarthest_px, top = kFarthest_px, right = -kFarthest_px, bottom = -kFarthest_px;
  for (const std::vector<cv::Point2f>& outline : outlines) {
    closed.push_back(usable(outline));
    for (const cv::Point2f& point : closed.back()) {
      left = std::min(left, point.x), right = std::max(right, point.x);
      top = std::min(top, point.y), bottom = std::max(bottom, point.y);
    }
  }
  if (left > right) return {};
  const cv::Rect box =
      cv::Rect(cv::Point(cvFloor(left), cvFloor(top)), cv::Point(cvCeil(right) + 1, cvCeil(bottom) + 1)) &
      cv::Rect({}, mask.size());
  if (box.empty()) return {};
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(box.height));
  for (const std::vector<cv::Point2f>& outline : closed) addCrossings(outline, box.y, crossings);
  for (int i = 0; i < box.height; ++i) {
    std::vector<double>& xs = crossings[static_cast<std::size_t>(i)];
    std::ranges::sort(xs);
    auto* row = mask.ptr(box.y + i);
    for (std::size_t pair = 0; pair + 1 < xs.size(); pair += 2) {
      const int first = std::max(cvCeil(xs[pair]), box.x);
      const int end = std::min(cvCeil(xs[pair + 1]), box.br().x);
      if (first < end) std::fill(row + first, row + end, valueOf(mode));
    }
  }
  return box;
}

cv::Rect fillHole(cv::Mat& mask, const cv::Point& point) {
  SCANTROVE_CHECK(mask.type() == CV_8UC1);
  const cv::Rect box = cv::boundingRect(mask);  // a hole lies within it, and touches none of its sides
  if (!box.contains(point) || mask.at<std::uint8_t>(point) != 0) return {};
  cv::Mat crop = mask(box).clone();
  cv::Rect hole;
  constexpr int kFilled = 128;
  cv::floodFill(crop, point - box.tl(), kFilled, &hole, 0, 0, 4);
  const bool is_open = hole.x == 0 || hole.y == 0 || hole.br().x == crop.cols || hole.br().y == crop.rows;
  if (is_open) return {};
  mask(hole + box.tl()).setTo(255, crop(hole) == kFilled);
  return hole + box.tl();
}

}  // namespace scantrove
