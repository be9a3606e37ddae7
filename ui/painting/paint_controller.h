#pragma once
#include <QColor>
#include <QObject>
#include <QRect>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/dataset/labeled_scan.h"
#include "core/editing/operation.h"
#include "core/scan/key_frame_labels.h"
#include "ui/painting/mask_tool.h"

namespace scantrove {

/// Turns what a person draws in the image of a key frame into operations of the scan. Its masks show at once
/// what was painted; the scan follows. Use from the window's thread.
class PaintController : public QObject {
  Q_OBJECT

 public:
  explicit PaintController(QObject* parent = nullptr) : QObject(parent) {}

  /// The image with the masks of the scan; operations under way are shown on top.
  void setLabels(const KeyFrameLabels& labels);
  void clear();
  [[nodiscard]] bool hasLabels() const { return labels_.index >= 0; }
  [[nodiscard]] const KeyFrameLabels& labels() const { return labels_; }
  /// CV_32SC1, with the operations under way; empty: no labels.
  [[nodiscard]] const cv::Mat& regions() const { return regions_; }
  /// 0: none, or beside the image.
  [[nodiscard]] RegionId regionAt(const cv::Point2f& at) const;

  void setTool(PaintTool tool);
  [[nodiscard]] PaintTool tool() const { return tool_kind_; }
  /// The brush's radius, and the reach of the magic edge.
  void setRadius(float radius_px);
  void setThisImageOnly(bool only) { this_image_only_ = only; }
  void setNewRegion(bool is_new) { is_new_region_ = is_new; }
  /// The region that is painted; none: the one under the first pixel.
  void setTarget(RegionId region) { selected_ = region; }

  // Inputs, in pixels of the image. Nothing happens without labels or with the tool select.
  void press(const cv::Point2f& at);
  void drag(const cv::Point2f& at);
  void release(const cv::Point2f& at);
  void complete();
  void stepBack();
  /// Drops what is being drawn.
  void cancel();
  [[nodiscard]] bool isDrawing() const { return tool_ != nullptr && tool_->isDrawing(); }
  /// Null: the tool select.
  [[nodiscard]] const MaskTool* activeTool() const { return tool_.get(); }
  /// Of what is being drawn.
  [[nodiscard]] QColor draftColor() const;

  /// An operation of operationReady() took effect or failed.
  void end(const Operation& operation);
  /// Takes back what was painted for the region in this image.
  void resetMask(RegionId region);

 signals:
  void draftChanged(const QRect& changed);
  void regionsChanged();
  void operationReady(const scantrove::Operation& operation);
  /// What was painted becomes a region of its own, which the scan is still to make.
  void newRegionPainted();
  void failed(const QString& message);

 private:
  /// An operation that the scan has not confirmed yet.
  struct Pending {
    Operation operation;
    std::vector<PaintedMask> masks;
  };
  void step(ToolStep step);
  void finish();
  void fill(const cv::Point2f& at);
  void snap(const cv::Mat& rough, RegionId target, bool makes_region);
  /// Makes an operation of painted pixels, CV_8UC1.
  void paint(const cv::Mat& painted, PaintMode mode, RegionId target, bool makes_region);
  void makeRegion(const cv::Mat& painted);
  void perform(const Operation& operation, const PaintedMask& shown);
  void showPending();
  [[nodiscard]] Operation operationOn(RegionId region, OperationKind kind) const;
  [[nodiscard]] RegionId targetAt(const cv::Point2f& at) const;

  KeyFrameLabels labels_;
  cv::Mat regions_;
  std::vector<Pending> pending_;
  PaintTool tool_kind_ = PaintTool::select;
  std::unique_ptr<MaskTool> tool_;
  float radius_px_ = 5;
  bool this_image_only_ = false, is_new_region_ = false;
  RegionId selected_;
  int image_number_ = 0;  ///< counts the shown images; a computation for an earlier one is dropped
};

}  // namespace scantrove
