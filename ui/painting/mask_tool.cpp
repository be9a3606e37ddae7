#include "ui/painting/mask_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <utility>

namespace scantrove {
namespace {

/// A click as near as this to the first corner closes a polygon.
constexpr float kClosing_px = 3;
/// Points of a free outline are at least this far apart.
constexpr float kOutlineStep_px = 0.5F;

float distanceOf(const cv::Point2f& a, const cv::Point2f& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Brush and eraser: a drag paints what lies within the radius of its path.
class StrokeTool final : public MaskTool {
 public:
  explicit StrokeTool(const cv::Size& size) : MaskTool(size) {}

  ToolStep press(const cv::Point2f& at) override {
    points_ = {at};
    note(paintStroke(draft_, points_, radius_px_, PaintMode::add));
    return ToolStep::drawing;
  }
  ToolStep drag(const cv::Point2f& at) override {
    if (points_.empty()) return ToolStep::idle;
    const std::array segment{points_.back(), at};
    points_.push_back(at);
    note(paintStroke(draft_, segment, radius_px_, PaintMode::add));
    return ToolStep::drawing;
  }
  ToolStep release(const cv::Point2f& at) override {
    return drag(at) == ToolStep::idle ? ToolStep::idle : ToolStep::finished;
  }
};

/// Clicks are corners. A click on the first one, a double click or Return closes the outline.
class PolygonTool final : public MaskTool {
 public:
  explicit PolygonTool(const cv::Size& size) : MaskTool(size) {}

  ToolStep press(const cv::Point2f& at) override {
    const bool closes = points_.size() >= 3 && distanceOf(at, points_.front()) <= kClosing_px;
    if (closes) return complete();
    points_.push_back(at);
    pointer_ = at;
    return ToolStep::drawing;
  }
  ToolStep drag(const cv::Point2f& at) override {
    pointer_ = at;
    return points_.empty() ? ToolStep::idle : ToolStep::drawing;
  }
  ToolStep release(const cv::Point2f& at) override { return drag(at); }
  ToolStep complete() override {
    // A double click adds its corner twice.
    if (points_.size() >= 2 && points_.back() == points_[points_.size() - 2]) points_.pop_back();
    if (points_.size() < 3) return points_.empty() ? ToolStep::idle : ToolStep::drawing;
    const std::array outlines{points_};
    note(paintPolygon(draft_, outlines, PaintMode::add));
    return ToolStep::finished;
  }
  ToolStep stepBack() override {
    if (!points_.empty()) points_.pop_back();
    return points_.empty() ? ToolStep::idle : ToolStep::drawing;
  }
  [[nodiscard]] std::vector<cv::Point2f> outline() const override {
    std::vector<cv::Point2f> line = points_;
    if (!line.empty()) line.push_back(pointer_);
    return line;
  }

 private:
  cv::Point2f pointer_;
};

/// A drag around a thing is its rough outline.
class OutlineTool final : public MaskTool {
 public:
  explicit OutlineTool(const cv::Size& size) : MaskTool(size) {}

  ToolStep press(const cv::Point2f& at) override {
    points_ = {at};
    return ToolStep::drawing;
  }
  ToolStep drag(const cv::Point2f& at) override {
    if (points_.empty()) return ToolStep::idle;
    if (distanceOf(at, points_.back()) >= kOutlineStep_px) points_.push_back(at);
    return ToolStep::drawing;
  }
  ToolStep release(const cv::Point2f& at) override {
    if (drag(at) == ToolStep::idle) return ToolStep::idle;
    const std::array outlines{points_};
    note(paintPolygon(draft_, outlines, PaintMode::add));
    return ToolStep::finished;
  }
  [[nodiscard]] std::vector<cv::Point2f> outline() const override { return points_; }
};

/// A click is the whole input; the hole depends on the mask that is filled.
class PointTool final : public MaskTool {
 public:
  explicit PointTool(const cv::Size& size) : MaskTool(size) {}

  ToolStep press(const cv::Point2f& at) override {
    points_ = {at};
    return ToolStep::finished;
  }
  ToolStep drag(const cv::Point2f& /*at*/) override { return ToolStep::idle; }
  ToolStep release(const cv::Point2f& /*at*/) override { return ToolStep::idle; }
};

}  // namespace

MaskTool::MaskTool(const cv::Size& size) : draft_(cv::Mat::zeros(size, CV_8UC1)) {}

std::unique_ptr<MaskTool> MaskTool::make(PaintTool tool, const cv::Size& size) {
  switch (tool) {
    case PaintTool::brush:
    case PaintTool::eraser:
      return std::make_unique<StrokeTool>(size);
    case PaintTool::polygon:
      return std::make_unique<PolygonTool>(size);
    case PaintTool::magic_edge:
      return std::make_unique<OutlineTool>(size);
    case PaintTool::fill_hole:
      return std::make_unique<PointTool>(size);
    case PaintTool::select:
      break;
  }
  return nullptr;
}

void MaskTool::reset() {
  note(cv::boundingRect(draft_));
  draft_ = cv::Mat(draft_.size(), CV_8UC1, cv::Scalar(0));  // a new one: the former one may be in use
  points_.clear();
}

cv::Rect MaskTool::takeChanged() { return std::exchange(changed_, cv::Rect()); }

int regionAround(const cv::Mat& regions, const cv::Point& at) {
  const cv::Rect all({}, regions.size());
  if (!all.contains(at)) return 0;
  const int inside = regions.at<int>(at);
  cv::Mat part = regions == inside;
  cv::Rect box;
  constexpr int kPart = 128;
  cv::floodFill(part, at, kPart, &box, 0, 0, 4);
  std::map<int, int> borders;
  for (int y = box.y; y < box.br().y; ++y) {
    for (int x = box.x; x < box.br().x; ++x) {
      if (part.at<std::uint8_t>(y, x) != kPart) continue;
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point next = cv::Point(x, y) + step;
        if (all.contains(next) && regions.at<int>(next) != inside) ++borders[regions.at<int>(next)];
      }
    }
  }
  borders.erase(0);
  const auto most = std::ranges::max_element(borders, {}, [](const auto& border) { return border.second; });
  return most == borders.end() ? 0 : most->first;
}

}  // namespace scantrove
