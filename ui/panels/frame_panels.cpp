#include "ui/panels/frame_panels.h"

#include <algorithm>

#include "ui/panels/color_panel.h"
#include "ui/panels/depth_panel.h"

namespace scantrove {
namespace {
constexpr int kPanelGap = 8;
constexpr int kMargin = 8;
constexpr float kRangeFollowing =
    0.1F;  ///< of the way to the frame's own range, so that colours do not flicker
}  // namespace

FramePanels::FramePanels(QWidget* parent)
    : QWidget(parent),
      color_(new ColorPanel(this)),
      depth_raw_(
          new DepthPanel(tr("Depth, camera"), tr("Distance as the camera measured it in this frame."), this)),
      depth_fused_(
          new DepthPanel(tr("Depth, fused"),
                         tr("Distance to the surface fused from all frames so far, seen from the same place: "
                            "fewer holes, less noise."),
                         this)),
      segments_(new ImagePanel(
          tr("Segments, this frame"),
          tr("This frame alone, cut where surfaces bend inwards. Colours mean nothing from one "
             "frame to the next."),
          this)),
      regions_(new ImagePanel(
          tr("Regions, merged"),
          tr("Segments merged over all frames. The same colour is the same region, here and in "
             "the 3D view. While a selected object is in view, the other regions are dark."),
          this)),
      panels_{color_, depth_raw_, depth_fused_, segments_, regions_} {
  for (ImagePanel* panel : panels_) {
    connect(panel, &ImagePanel::activated, this, [this, panel] { feature(panel); });
  }
}

void FramePanels::showSnapshot(const ScanSnapshot& snapshot) {
  color_->setFrame(colorPicture(snapshot.color), snapshot.objects);
  color_->setGhost(colorPicture(snapshot.last_seen));
  const DepthRange now = usualRange(snapshot.depth_raw_m, range_);
  const float follow = has_range_ ? kRangeFollowing : 1.0F;
  range_.near_m += follow * (now.near_m - range_.near_m);
  range_.far_m += follow * (now.far_m - range_.far_m);
  has_range_ = true;
  depth_raw_->setDepth(snapshot.depth_raw_m, range_);
  depth_fused_->setDepth(snapshot.depth_fused_m, range_);
  segments_->setPicture(segmentPicture(snapshot.segments));
  region_ids_ = snapshot.regions;
  objects_ = snapshot.objects;
  showRegions();
}

void FramePanels::setSelected(const std::set<ObjectId>& selected) {
  if (selected == selected_) return;
  selected_ = selected;
  color_->setSelected(selected);
  showRegions();
}

void FramePanels::showRegions() {
  std::set<RegionId> lit;
  for (const SeenObject& object : objects_) {
    if (selected_.contains(object.object)) lit.insert(object.regions.begin(), object.regions.end());
  }
  regions_->setPicture(regionPicture(region_ids_, lit));
}

void FramePanels::clear() {
  region_ids_.release();
  objects_.clear();
  for (ImagePanel* panel : panels_) panel->setPicture({});
  color_->setFrame({}, {});
  color_->setGhost({});
  has_range_ = false;
}

void FramePanels::feature(ImagePanel* panel) {
  const auto place = std::find(panels_.begin(), panels_.end(), panel);
  if (place == panels_.end()) return;
  // A second click on the large one goes back to the colour image.
  featured_ = static_cast<std::size_t>(place - panels_.begin()) == featured_
                  ? 0
                  : static_cast<std::size_t>(place - panels_.begin());
  arrange();
}

void FramePanels::resizeEvent(QResizeEvent* /*event*/) { arrange(); }

void FramePanels::arrange() {
  // Large picture w x 3/4 w over a grid of two columns: the height is 3/2 w plus gaps.
  const int available = height() - 2 * kMargin - 2 * kPanelGap;
  const int w = std::max(100, std::min(width() - 2 * kMargin, available * 2 / 3 + kPanelGap / 2));
  const int left = (width() - w) / 2;
  const int small_width = (w - kPanelGap) / 2;
  const int small_height = small_width * 3 / 4;
  const int large_height = w * 3 / 4;
  panels_[featured_]->setGeometry(left, kMargin, w, large_height);
  panels_[featured_]->setClickMeaning(featured_ == 0 ? QString() : tr("Click: the colour image large again"));
  int cell = 0;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    if (i == featured_) continue;
    panels_[i]->setClickMeaning(tr("Click: show it large"));
    const int x = left + (cell % 2) * (w - small_width);
    const int y = kMargin + large_height + kPanelGap + (cell / 2) * (small_height + kPanelGap);
    panels_[i]->setGeometry(x, y, small_width, small_height);
    ++cell;
  }
}

}  // namespace scantrove
