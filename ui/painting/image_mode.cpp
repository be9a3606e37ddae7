#include "ui/painting/image_mode.h"

#include <QAction>
#include <QCheckBox>
#include <algorithm>
#include <variant>

#include "ui/models/region_selection.h"
#include "ui/painting/image_canvas.h"
#include "ui/painting/image_page.h"
#include "ui/painting/image_view_bar.h"
#include "ui/painting/paint_controller.h"
#include "ui/painting/paint_tool_bar.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/image_conversion.h"
#include "ui/panels/image_panel.h"
#include "ui/panels/region_picture.h"

namespace scantrove {
namespace {

/// Indices of pictures in FramePanels.
constexpr int kColorPicture = 0;
constexpr std::size_t kFusedPicture = 2, kRegionsPicture = 4;

cv::Point2f pointOf(const QPointF& at) { return {static_cast<float>(at.x()), static_cast<float>(at.y())}; }

}  // namespace

ImageMode::ImageMode(const Parts& parts, QObject* parent)
    : QObject(parent), parts_(parts), painting_(new PaintController(this)) {
  parts_.page.hide();
  connect(&parts_.action, &QAction::toggled, this, &ImageMode::setActive);
  QStringList titles;
  for (const ImagePanel* panel : parts_.frames.panels()) titles << panel->title();
  parts_.page.view().setPictures(titles);
  connect(&parts_.frames, &FramePanels::opened, this, [this](int index) {
    parts_.page.view().setPicture(index);
    parts_.action.setChecked(true);
  });
  connectScan();
  connectCanvas();
  connectBars();
  connect(painting_, &PaintController::operationReady, this, &ImageMode::operationReady);
  connect(painting_, &PaintController::failed, this, &ImageMode::failed);
  connect(painting_, &PaintController::draftChanged, this, &ImageMode::showDraft);
  connect(painting_, &PaintController::regionsChanged, this, [this] {
    refresh();
    refreshNames();
    refreshHighlight();
  });
  updateTool();
}

bool ImageMode::isActive() const { return parts_.action.isChecked(); }

void ImageMode::connectScan() {
  ScanBridge& bridge = parts_.bridge;
  connect(&bridge, &ScanBridge::snapshotArrived, this,
          [this](const std::shared_ptr<const ScanSnapshot>& snapshot) { showSnapshot(*snapshot); });
  bridge.on<KeyFrameLabeled>(this, [this](const KeyFrameLabeled& labeled) {
    if (labeled.labels.index != shown_key_frame_) return;  // another one is shown meanwhile
    painting_->setLabels(labeled.labels);
    updateTool();
  });
  bridge.on<StateChanged>(this, [this](StateChanged changed) {
    if (changed.state != ScanState::starting) return;
    shown_key_frame_ = -1;
    painting_->clear();
    refresh();
    updateTool();
  });
  bridge.on<Edited>(this, [this](const Edited& event) { noteEdit(event.edit); });
  bridge.on<EditFailed>(this, [this](const EditFailed& event) { noteEdit(event.edit); });
  connect(&parts_.selection, &RegionSelection::hoverChanged, this, &ImageMode::refreshHighlight);
  connect(&parts_.selection, &RegionSelection::selectionChanged, this, &ImageMode::refreshHighlight);
  connect(&parts_.selection, &RegionSelection::infosChanged, this, &ImageMode::refreshNames);
}

void ImageMode::connectCanvas() {
  ImageCanvas& canvas = parts_.page.canvas();
  connect(&canvas, &ImageCanvas::pressed, this, &ImageMode::press);
  connect(&canvas, &ImageCanvas::dragged, this, [this](const QPointF& at) { painting_->drag(pointOf(at)); });
  connect(&canvas, &ImageCanvas::released, this, &ImageMode::release);
  connect(&canvas, &ImageCanvas::pointedAt, this, [this](const QPointF& at) {
    if (painting_->isDrawing()) return painting_->drag(pointOf(at));  // the outline follows the pointer
    emit pointedAt(pointAt(at));
  });
  connect(&canvas, &ImageCanvas::pointerLeft, this, &ImageMode::pointerLeft);
  connect(&canvas, &ImageCanvas::doubleClicked, this, [this](const QPointF& at, const QPoint& on_screen) {
    if (painting_->isDrawing()) return painting_->complete();
    emit doubleClicked(pointAt(at), on_screen);
  });
  connect(&canvas, &ImageCanvas::menuRequested, this, [this](const QPointF& at, const QPoint& on_screen) {
    if (!painting_->isDrawing()) emit menuRequested(pointAt(at), on_screen);
  });
  connect(&canvas, &ImageCanvas::cancelled, painting_, &PaintController::cancel);
  connect(&canvas, &ImageCanvas::completed, painting_, &PaintController::complete);
  connect(&canvas, &ImageCanvas::steppedBack, painting_, &PaintController::stepBack);
  connect(&canvas, &ImageCanvas::brushStepped, &parts_.page.tools(), &PaintToolBar::stepBrush);
  connect(&canvas, &ImageCanvas::nextPictureRequested, &parts_.page.view(), &ImageViewBar::nextPicture);
}

void ImageMode::connectBars() {
  PaintToolBar& tools = parts_.page.tools();
  connect(&tools, &PaintToolBar::toolChosen, this, &ImageMode::updateTool);
  connect(&tools, &PaintToolBar::brushSizeChanged, this, &ImageMode::updateTool);
  connect(tools.newRegionBox(), &QCheckBox::toggled, painting_, &PaintController::setNewRegion);
  // One region for each tick. The earlier selection is not what the next stroke is for.
  connect(painting_, &PaintController::newRegionPainted, this, [this] {
    parts_.page.tools().newRegionBox()->setChecked(false);
    parts_.selection.select(RegionId{});
  });
  connect(tools.thisImageBox(), &QCheckBox::toggled, painting_, &PaintController::setThisImageOnly);
  connect(tools.resetAction(), &QAction::triggered, this, [this] {
    const std::vector<RegionId>& selected = parts_.selection.selected();
    if (selected.empty()) return emit failed(tr("Select the region whose mask is to be reset."));
    painting_->resetMask(selected.front());
  });
  connect(&parts_.page.view(), &ImageViewBar::changed, this, [this] {
    refresh();
    refreshNames();
    refreshHighlight();
    updateTool();
  });
  connect(&parts_.page.view(), &ImageViewBar::besideToggled, this, [this] { setActive(isActive()); });
}

void ImageMode::setActive(bool active) {
  if (!active) painting_->cancel();
  parts_.page.setVisible(active);
  parts_.scene.setVisible(!active || parts_.page.view().besideAction()->isChecked());
  if (!active) return;
  parts_.page.canvas().setFocus(Qt::OtherFocusReason);
  if (!painting_->hasLabels()) requestLabels();
  refresh();
  refreshNames();
  refreshHighlight();
  updateTool();
  showCamera();
}

void ImageMode::showSnapshot(const ScanSnapshot& snapshot) {
  const int shown = snapshot.key_frames != nullptr ? snapshot.shown_key_frame : -1;
  T_world_camera_ = snapshot.pose.T_world_camera;
  if (shown != shown_key_frame_) {
    shown_key_frame_ = shown;
    painting_->clear();
    updateTool();
    requestLabels();
    showCamera();
  }
  refresh();
  refreshHighlight();
}

void ImageMode::requestLabels() {
  if (isActive() && shown_key_frame_ >= 0) parts_.bridge.post(LabelKeyFrame{shown_key_frame_});
}

void ImageMode::noteEdit(const ScanEdit& edit) {
  if (const auto* const operation = std::get_if<Operation>(&edit)) painting_->end(*operation);
  if (isActive()) return requestLabels();
  if (!painting_->hasLabels()) return;
  painting_->clear();  // read anew when they are needed
  updateTool();
}

FramePointing::Picture ImageMode::kind() const {
  return parts_.page.view().picture() == kColorPicture ? FramePointing::Picture::color
                                                       : FramePointing::Picture::other;
}

bool ImageMode::isPaintable() const {
  return painting_->hasLabels() &&
         (kind() == FramePointing::Picture::color || !parts_.frames.pointing().mapsColor());
}

cv::Mat ImageMode::shownRegions() const {
  return isPaintable() ? painting_->regions() : parts_.frames.pointing().regionIds(kind());
}

QImage ImageMode::comparedPicture() const {
  if (isPaintable()) {
    const cv::Mat& fused_m = painting_->labels().fused_m;
    return depthPicture(fused_m, usualRange(fused_m, DepthRange{}));
  }
  const bool is_aligned = kind() == FramePointing::Picture::other || !parts_.frames.pointing().mapsColor();
  return is_aligned ? parts_.frames.panels()[kFusedPicture]->picture() : QImage();
}

void ImageMode::refresh() {
  if (!isActive()) return;
  const ImageViewBar& view = parts_.page.view();
  const auto index = static_cast<std::size_t>(std::max(0, view.picture()));
  const cv::Mat regions = shownRegions();
  ImageCanvas::Layers layers;
  layers.picture = index == kRegionsPicture && isPaintable() ? regionPicture(regions)
                                                             : parts_.frames.panels()[index]->picture();
  layers.second_opacity = view.comparison();
  if (layers.second_opacity > 0) layers.second = comparedPicture();
  layers.masks = index == kRegionsPicture ? QImage() : maskPicture(regions, view.style());
  layers.masks_opacity = view.style() == MaskStyle::outline ? 1 : view.masksOpacity();
  size_ = isPaintable() ? QSize(regions.cols, regions.rows) : layers.picture.size();
  parts_.page.canvas().setLayers(layers, size_);
}

void ImageMode::refreshNames() {
  if (!isActive()) return;
  std::vector<MaskName> names;
  if (parts_.page.view().showsNames() && isPaintable()) {
    names = maskNames(painting_->regions(), [this](RegionId region) {
      const RegionInfo* const info = parts_.selection.info(region);
      return info != nullptr ? QString::fromStdString(info->name()) : QString();
    });
  }
  parts_.page.canvas().setNames(std::move(names));
}

void ImageMode::refreshHighlight() {
  if (!isActive()) return;
  const RegionId hovered = parts_.selection.hovered();
  const std::vector<RegionId>& selected = parts_.selection.selected();
  // A tool paints the selection; what the pointer passes over does not matter.
  const bool paints = isPaintable() && parts_.page.tools().tool() != PaintTool::select;
  const bool is_any = (hovered && !paints) || !selected.empty();
  parts_.page.canvas().setHighlight(
      is_any ? highlightPicture(shownRegions(), paints ? RegionId{} : hovered, selected) : QImage());
}

void ImageMode::showDraft(const QRect& changed) {
  ImageCanvas& canvas = parts_.page.canvas();
  if (const MaskTool* const tool = painting_->activeTool()) {
    canvas.showDraft(tool->draft(), changed, painting_->draftColor());
    QPolygonF outline;
    for (const cv::Point2f& point : tool->outline())
      outline << QPointF(static_cast<double>(point.x), static_cast<double>(point.y));
    canvas.setOutline(outline);
  }
  canvas.setKeysTaken(painting_->isDrawing());
}

void ImageMode::showCamera() {
  const bool is_beside = parts_.page.view().besideAction()->isChecked();
  if (isActive() && is_beside && shown_key_frame_ >= 0) emit cameraShown(T_world_camera_);
}

void ImageMode::updateTool() {
  PaintToolBar& tools = parts_.page.tools();
  ImageCanvas& canvas = parts_.page.canvas();
  const bool can_paint = isPaintable();
  const PaintTool tool = can_paint ? tools.tool() : PaintTool::select;
  tools.setCanPaint(can_paint);
  if (tool != painting_->tool() || (can_paint && painting_->activeTool() == nullptr))
    painting_->setTool(tool);
  painting_->setRadius(static_cast<float>(tools.brushSize()) / 2);
  const bool has_circle =
      tool == PaintTool::brush || tool == PaintTool::eraser || tool == PaintTool::magic_edge;
  canvas.setBrushRadius(has_circle ? std::optional(tools.brushSize() / 2.0) : std::nullopt);
  canvas.setDoubleClicksDraw(tool != PaintTool::select && tool != PaintTool::polygon);
  refreshHighlight();
}

RegionPoint ImageMode::pointAt(const QPointF& at) const {
  if (size_.isEmpty()) return {};
  const QPointF fraction((at.x() + 0.5) / size_.width(), (at.y() + 0.5) / size_.height());
  const bool is_inside = QRectF(0, 0, 1, 1).contains(fraction);
  RegionPoint point = is_inside ? parts_.frames.pointing().at(fraction, kind()) : RegionPoint{};
  if (isPaintable()) point.region = painting_->regionAt(pointOf(at));
  return point;
}

void ImageMode::setTag(const QStringList& tag) { parts_.page.canvas().setTag(tag); }

void ImageMode::press(const QPointF& at) {
  if (painting_->activeTool() == nullptr) return;
  const std::vector<RegionId>& selected = parts_.selection.selected();
  if (!painting_->isDrawing()) painting_->setTarget(selected.empty() ? RegionId{} : selected.front());
  setTag({});
  painting_->press(pointOf(at));
}

void ImageMode::release(const QPointF& at, Qt::KeyboardModifiers modifiers) {
  if (painting_->activeTool() != nullptr) return painting_->release(pointOf(at));
  emit clicked(pointAt(at), modifiers);
}

}  // namespace scantrove
