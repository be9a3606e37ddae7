#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/editing/mask_tools.h"

namespace scantrove {

/// Tools of the image mode.
enum class PaintTool { select, brush, eraser, polygon, magic_edge, fill_hole };

/// What an input to a tool led to.
enum class ToolStep {
  idle,     ///< nothing is drawn
  drawing,  ///< the draft or the outline may have changed
  finished  ///< the draft is complete: take it, then reset()
};

/// One tool: inputs in pixels of the image, pixel centres at integers, become a draft of painted pixels. No
/// widgets.
class MaskTool {
 public:
  /// `size` of the image. Null for select.
  [[nodiscard]] static std::unique_ptr<MaskTool> make(PaintTool tool, const cv::Size& size);
  virtual ~MaskTool() = default;
  MaskTool(const MaskTool&) = delete;
  MaskTool& operator=(const MaskTool&) = delete;

  /// The brush's radius; of the magic edge its reach. Holds for what is drawn from now on.
  void setRadius(float radius_px) { radius_px_ = radius_px; }

  virtual ToolStep press(const cv::Point2f& at) = 0;
  virtual ToolStep drag(const cv::Point2f& at) = 0;
  virtual ToolStep release(const cv::Point2f& at) = 0;
  /// Return or a double click.
  virtual ToolStep complete() { return ToolStep::idle; }
  /// Takes back the last point of an outline.
  virtual ToolStep stepBack() { return ToolStep::idle; }
  /// Drops what is drawn.
  void reset();

  [[nodiscard]] bool isDrawing() const { return !points_.empty(); }
  /// Where it began; while drawing, or finished.
  [[nodiscard]] const cv::Point2f& start() const { return points_.front(); }
  /// CV_8UC1 of the image's size, 255 = painted.
  [[nodiscard]] const cv::Mat& draft() const { return draft_; }
  /// The pixels of the draft that changed since the last call.
  [[nodiscard]] cv::Rect takeChanged();
  /// An outline in progress, from its first point to the pointer; empty: the tool has none.
  [[nodiscard]] virtual std::vector<cv::Point2f> outline() const { return {}; }

 protected:
  explicit MaskTool(const cv::Size& size);
  void note(const cv::Rect& changed) { changed_ |= changed; }

  cv::Mat draft_;
  std::vector<cv::Point2f> points_;
  float radius_px_ = 1;

 private:
  cv::Rect changed_;
};

/// The region that surrounds the pixels connected to `at` that show one region: the one that borders on most
/// of them; 0: none. `regions`: CV_32SC1.
[[nodiscard]] int regionAround(const cv::Mat& regions, const cv::Point& at);

}  // namespace scantrove
