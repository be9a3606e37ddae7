#include "ui/painting/paint_controller.h"

#include <QFuture>
#include <QPromise>
#include <QScopedValueRollback>
#include <QThreadPool>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "core/dataset/painted_masks.h"
#include "core/editing/magic_edge.h"
#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

/// Stands for a new region until the scan has made it.
constexpr int kNewRegion = std::numeric_limits<int>::max();
constexpr float kLeastReach_px = 2, kMostReach_px = 40;
const QColor kErased(0xff, 0x4d, 0x6d, 190);
constexpr int kDraftAlpha = 190;

cv::Point pixelOf(const cv::Point2f& at) { return {cvRound(at.x), cvRound(at.y)}; }

/// The region that most painted pixels show; 0: they show none.
int mostShown(const cv::Mat& painted, const cv::Mat& regions) {
  std::map<int, int> pixels;
  for (int y = 0; y < painted.rows; ++y) {
    for (int x = 0; x < painted.cols; ++x) {
      const int region = regions.at<int>(y, x);
      if (painted.at<std::uint8_t>(y, x) != 0 && region > 0 && region != kNewRegion) ++pixels[region];
    }
  }
  const auto most = std::ranges::max_element(pixels, {}, [](const auto& count) { return count.second; });
  return most == pixels.end() ? 0 : most->first;
}

}  // namespace

void PaintController::setLabels(const KeyFrameLabels& labels) {
  const bool is_same = labels.index == labels_.index && labels.regions.size() == labels_.regions.size();
  labels_ = labels;
  if (!is_same) {
    pending_.clear();
    ++image_number_;
    setTool(tool_kind_);
  }
  showPending();
}

void PaintController::clear() {
  cancel();
  ++image_number_;
  labels_ = {};
  regions_.release();
  pending_.clear();
  tool_.reset();
}

void PaintController::showPending() {
  regions_ = pending_.empty() ? labels_.regions : labels_.regions.clone();
  for (const Pending& one : pending_) applyPaintedMasks(one.masks, regions_);
  emit regionsChanged();
}

RegionId PaintController::regionAt(const cv::Point2f& at) const {
  const cv::Point pixel = pixelOf(at);
  if (!cv::Rect({}, regions_.size()).contains(pixel)) return {};
  const int region = regions_.at<int>(pixel);
  return region == kNewRegion ? RegionId{} : RegionId{static_cast<std::uint32_t>(std::max(0, region))};
}

RegionId PaintController::targetAt(const cv::Point2f& at) const {
  return selected_ ? selected_ : regionAt(at);
}

void PaintController::setTool(PaintTool tool) {
  cancel();
  tool_kind_ = tool;
  tool_ = hasLabels() ? MaskTool::make(tool, labels_.regions.size()) : nullptr;
  if (tool_ != nullptr) tool_->setRadius(radius_px_);
}

void PaintController::setRadius(float radius_px) {
  radius_px_ = radius_px;
  if (tool_ != nullptr) tool_->setRadius(radius_px);
}

void PaintController::press(const cv::Point2f& at) {
  if (tool_ != nullptr) step(tool_->press(at));
}
void PaintController::drag(const cv::Point2f& at) {
  if (isDrawing()) step(tool_->drag(at));
}
void PaintController::release(const cv::Point2f& at) {
  if (isDrawing()) step(tool_->release(at));
}
void PaintController::complete() {
  if (isDrawing()) step(tool_->complete());
}
void PaintController::stepBack() {
  if (isDrawing()) step(tool_->stepBack());
}

void PaintController::cancel() {
  if (tool_ == nullptr) return;
  tool_->reset();
  step(ToolStep::idle);
}

void PaintController::step(ToolStep step) {
  if (step == ToolStep::finished) {
    finish();
    tool_->reset();
  }
  const cv::Rect changed = tool_->takeChanged();
  emit draftChanged({changed.x, changed.y, changed.width, changed.height});
}

QColor PaintController::draftColor() const {
  if (tool_kind_ == PaintTool::eraser) return kErased;
  const RegionId region = is_new_region_ || !isDrawing() ? RegionId{kNewRegion} : targetAt(tool_->start());
  const Rgb color = regionColor(region);
  return {color[0], color[1], color[2], kDraftAlpha};
}

void PaintController::finish() {
  const cv::Point2f start = tool_->start();
  const cv::Mat painted = tool_->draft();
  if (tool_kind_ == PaintTool::fill_hole) return fill(start);
  if (cv::countNonZero(painted) == 0) return;
  const bool erases = tool_kind_ == PaintTool::eraser;
  const RegionId target = targetAt(start);
  if (!target && (erases || !is_new_region_))
    return emit failed(
        tr("There is no region under the first pixel. Select a region, or tick “New region”."));
  const bool makes_region = is_new_region_ && !erases;
  if (tool_kind_ == PaintTool::magic_edge) return snap(painted, target, makes_region);
  paint(painted, erases ? PaintMode::erase : PaintMode::add, target, makes_region);
}

void PaintController::fill(const cv::Point2f& at) {
  const cv::Point pixel = pixelOf(at);
  const RegionId target =
      selected_ ? selected_ : RegionId{static_cast<std::uint32_t>(regionAround(regions_, pixel))};
  const cv::Mat before = regions_ == static_cast<int>(target.value);
  cv::Mat filled = before.clone();
  if (!target || fillHole(filled, pixel).empty())
    return emit failed(tr("The region has no hole there. Click into a hole that it encloses."));
  paint(filled & (before == 0), PaintMode::add, target, false);  // a hole is filled with what encloses it
}

void PaintController::snap(const cv::Mat& rough, RegionId target, bool makes_region) {
  if (labels_.color.size() != rough.size())
    return emit failed(tr("The magic edge needs a colour image. Use the polygon here."));
  if (makes_region) emit newRegionPainted();  // at once: the next stroke may come before the edge is found
  const int reach_px = cvRound(std::clamp(radius_px_, kLeastReach_px, kMostReach_px));
  const auto promise = std::make_shared<QPromise<cv::Mat>>();
  promise->start();
  QThreadPool::globalInstance()->start([promise, color = labels_.color, rough = rough.clone(), reach_px] {
    const SnappedMask snapped = snapToEdges(color, rough, reach_px);
    cv::Mat mask = rough;
    if (!snapped.box.empty()) snapped.mask.copyTo(mask(snapped.box));
    promise->addResult(mask);
    promise->finish();
  });
  // The user may draw on meanwhile, and change what strokes do.
  promise->future().then(this, [this, number = image_number_, target, makes_region,
                                only = this_image_only_](const cv::Mat& mask) {
    if (number != image_number_) return;
    const QScopedValueRollback this_image(this_image_only_, only);
    paint(mask, PaintMode::add, target, makes_region);
  });
}

Operation PaintController::operationOn(RegionId region, OperationKind kind) const {
  const cv::Mat nothing = cv::Mat::zeros(labels_.regions.size(), CV_8UC1);
  Operation operation{.kind = kind, .regions = {region}};
  operation.correction = correctionOf(nothing, nothing);
  operation.correction->key_frame = labels_.key_frame;
  operation.correction->image = labels_.image;
  return operation;
}

void PaintController::paint(const cv::Mat& painted, PaintMode mode, RegionId target, bool makes_region) {
  const bool adds = mode == PaintMode::add;
  if (makes_region) return makeRegion(painted);
  const cv::Mat own = regions_ == static_cast<int>(target.value);
  if (cv::countNonZero(painted & (adds ? cv::Mat(own == 0) : own)) == 0) {
    if (!adds) emit failed(tr("The selected region has none of these pixels."));
    return;
  }
  Operation operation = operationOn(target, OperationKind::paint);
  (adds ? operation.correction->added : operation.correction->removed) = PaintedPixels::of(painted);
  operation.correction->this_image_only = this_image_only_;
  const cv::Mat nothing = cv::Mat::zeros(painted.size(), CV_8UC1);
  perform(operation,
          {.region = target.value, .added = adds ? painted : nothing, .removed = adds ? nothing : painted});
}

void PaintController::makeRegion(const cv::Mat& painted) {
  const int under = mostShown(painted, regions_);
  if (under == 0) return emit failed(tr("There is no scanned surface to make a region of."));
  Operation operation = operationOn(RegionId{static_cast<std::uint32_t>(under)}, OperationKind::paint);
  operation.correction->added = PaintedPixels::of(painted);
  operation.correction->removed = PaintedPixels::of(painted == 0);
  operation.correction->makes_region = true;
  perform(operation, {.region = static_cast<std::uint32_t>(kNewRegion),
                      .added = painted,
                      .removed = cv::Mat::zeros(painted.size(), CV_8UC1)});
  emit newRegionPainted();
}

void PaintController::perform(const Operation& operation, const PaintedMask& shown) {
  pending_.push_back({operation, {shown}});
  showPending();
  emit operationReady(operation);
}

void PaintController::resetMask(RegionId region) {
  if (hasLabels() && region) emit operationReady(operationOn(region, OperationKind::unpaint));
}

void PaintController::end(const Operation& operation) {
  // Edits end in the order in which they were sent. The scan completes what it stores of them, so that they
  // are not equal to what was sent.
  const auto found =
      std::ranges::find(pending_, operation.kind, [](const Pending& one) { return one.operation.kind; });
  if (found != pending_.end()) pending_.erase(found);
}

}  // namespace scantrove
