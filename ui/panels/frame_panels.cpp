#include "ui/panels/frame_panels.h"

#include <QApplication>
#include <algorithm>
#include <utility>

#include "ui/panels/color_panel.h"
#include "ui/panels/depth_panel.h"
#include "ui/panels/region_picture.h"
#include "ui/panels/regions_in_picture.h"

namespace scantrove {
namespace {
constexpr int kPanelGap = 8;
constexpr int kMargin = 8;
/// Share of the change to the range of the current frame; smooths the colours.
constexpr float kRangeFollowing = 0.1F;
}  // namespace

FramePanels::FramePanels(QWidget* parent)
    : QWidget(parent),
      color_(new ColorPanel(this)),
      depth_raw_(
          new DepthPanel(tr("Depth, camera"), tr("Depth as the camera measured it in this frame."), this)),
      depth_fused_(new DepthPanel(
          tr("Depth, fused"),
          tr("Depth of the fused map from the same pose, with fewer holes and less noise."), this)),
      segments_(new ImagePanel(tr("Segments, this frame"),
                               tr("Segments of this frame alone, split at concave edges. Their colours "
                                  "change from frame to frame."),
                               this)),
      regions_(new ImagePanel(tr("Regions, merged"),
                              tr("Segments merged over all frames. A region has the same colour here and in "
                                 "the 3D view. A selected object darkens the other regions."),
                              this)),
      panels_{color_, depth_raw_, depth_fused_, segments_, regions_} {
  for (ImagePanel* panel : panels_) {
    connect(panel, &ImagePanel::activated, this, [this, panel] {
      activated_panel_ = panel;
      since_activated_.start();
      feature(panel);
    });
    connect(panel, &ImagePanel::opened, this, [this, panel] {
      if (openActivated()) return;
      emit opened(static_cast<int>(std::find(panels_.begin(), panels_.end(), panel) - panels_.begin()));
    });
    connectPointing(panel);
  }
}

bool FramePanels::openActivated() {
  const bool is_recent =
      since_activated_.isValid() && !since_activated_.hasExpired(QApplication::doubleClickInterval());
  since_activated_.invalidate();
  if (!is_recent) return false;
  const auto found = std::find(panels_.begin(), panels_.end(), activated_panel_);
  emit opened(static_cast<int>(found - panels_.begin()));
  return true;
}

FramePointing::Picture FramePanels::pictureOf(const ImagePanel* panel) const {
  return panel == color_ ? FramePointing::Picture::color : FramePointing::Picture::other;
}

void FramePanels::connectPointing(ImagePanel* panel) {
  const auto at = [this, panel](const QPointF& fraction) { return pointing_.at(fraction, pictureOf(panel)); };
  connect(panel, &ImagePanel::pointedAt, this, [this, panel, at](const QPointF& fraction) {
    pointed_panel_ = panel;
    pointed_fraction_ = fraction;
    emit pointerMoved();
    emit pointedAt(at(fraction));
  });
  connect(panel, &ImagePanel::pointerLeft, this, [this, panel] {
    if (pointed_panel_ != panel) return;
    pointed_panel_ = nullptr;
    panel->setTag({});
    emit pointerLeft();
  });
  connect(panel, &ImagePanel::clicked, this,
          [this, at](const QPointF& fraction, Qt::KeyboardModifiers modifiers) {
            emit clicked(at(fraction), modifiers);
          });
  connect(panel, &ImagePanel::doubleClicked, this, [this, panel, at](const QPointF& fraction) {
    if (openActivated()) return;
    emit doubleClicked(at(fraction), panel->mapToGlobal(panel->positionOf(fraction).toPoint()));
  });
  connect(panel, &ImagePanel::menuRequested, this,
          [this, at](const QPointF& fraction, const QPoint& on_screen) {
            emit menuRequested(at(fraction), on_screen);
          });
  connect(panel, &ImagePanel::strokeAt, this,
          [this, at](const QPointF& fraction) { emit strokeAt(at(fraction)); });
  connect(panel, &ImagePanel::strokeEnded, this, &FramePanels::strokeEnded);
  connect(panel, &ImagePanel::bandDrawn, this,
          [this, panel](const QRectF& fractions, Qt::KeyboardModifiers modifiers) {
            emit bandDrawn(pointing_.regionsIn(fractions, pictureOf(panel)), modifiers);
          });
}

void FramePanels::setHighlight(RegionId hovered, const std::vector<RegionId>& selected) {
  if (hovered == hovered_region_ && selected == selected_regions_) return;
  hovered_region_ = hovered;
  selected_regions_ = selected;
  showHighlight();
}

void FramePanels::showHighlight() {
  const auto highlightIn = [this](FramePointing::Picture picture) {
    if (!hovered_region_ && selected_regions_.empty()) return QImage();
    return highlightPicture(pointing_.regionIds(picture), hovered_region_, selected_regions_);
  };
  const QImage highlight = highlightIn(FramePointing::Picture::other);
  for (ImagePanel* panel : panels_) {
    const bool has_own = panel == color_ && pointing_.mapsColor();
    panel->setHighlight(has_own ? highlightIn(FramePointing::Picture::color) : highlight);
  }
}

void FramePanels::setStrokeColor(const std::optional<QColor>& color) {
  for (ImagePanel* panel : panels_) panel->setStrokeColor(color);
}

void FramePanels::setMarks(std::vector<PointMarks> marks) {
  marks_ = std::move(marks);
  showMarks();
}

void FramePanels::showMarks() {
  for (ImagePanel* panel : panels_) {
    std::vector<ImagePanel::Marks> shown;
    for (const auto& [color, places] : marks_) {
      QPolygonF fractions;
      for (const Eigen::Vector3f& place : places) {
        if (const auto at = pointing_.positionOf(place, pictureOf(panel))) fractions << *at;
      }
      if (!fractions.isEmpty()) shown.push_back({color, fractions});
    }
    panel->setMarks(std::move(shown));
  }
}

void FramePanels::setTag(const QStringList& tag) {
  if (pointed_panel_ != nullptr) pointed_panel_->setTag(tag);
}

void FramePanels::featureNext() { feature(panels_[(featured_ + 1) % panels_.size()]); }

void FramePanels::showSnapshot(const ScanSnapshot& snapshot) {
  const bool has_frame = !snapshot.depth_raw_m.empty() || !snapshot.regions.empty();
  color_->setEmptyText(has_frame ? tr("This frame has no colour image.") : QString());
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
  pointing_.show(snapshot);
  showNames();
  showHighlight();
  showMarks();
  // The surface under the pointer may have changed.
  if (pointed_panel_ != nullptr) emit pointedAt(pointing_.at(pointed_fraction_, pictureOf(pointed_panel_)));
}

void FramePanels::setSelected(const std::set<ObjectId>& selected) {
  if (selected == selected_) return;
  selected_ = selected;
  color_->setSelected(selected);
  showRegions();
}

void FramePanels::setNames(std::map<RegionId, QString> names) {
  names_ = std::move(names);
  showNames();
}

void FramePanels::showNames() {
  constexpr int kLeastPixels = 30;
  std::set<RegionId> regions;
  for (const auto& [region, name] : names_) regions.insert(region);
  // Those of known objects have their own rectangles.
  for (const SeenObject& object : objects_) {
    if (!object.object) continue;
    for (const RegionId region : object.regions) regions.erase(region);
  }
  std::vector<ColorPanel::RegionLabelInImage> shown;
  const cv::Mat& ids = regions.empty() ? region_ids_ : pointing_.regionIds(FramePointing::Picture::color);
  for (const auto& [region, seen] : regionsInPicture(ids, regions, kLeastPixels)) {
    const QPointF fraction((seen.anchor_px.x + 0.5) / ids.cols, (seen.anchor_px.y + 0.5) / ids.rows);
    shown.push_back({fraction, names_.at(region)});
  }
  color_->setRegionNames(std::move(shown));
}

void FramePanels::showRegions() {
  std::set<RegionId> highlight;
  for (const SeenObject& object : objects_) {
    if (selected_.contains(object.object)) highlight.insert(object.regions.begin(), object.regions.end());
  }
  regions_->setPicture(regionPicture(region_ids_, highlight));
}

void FramePanels::clear() {
  region_ids_.release();
  objects_.clear();
  pointing_.clear();
  for (ImagePanel* panel : panels_) {
    panel->setPicture({});
    panel->setHighlight({});
  }
  color_->setEmptyText({});
  color_->setFrame({}, {});
  color_->setRegionNames({});
  color_->setGhost({});
  has_range_ = false;
}

void FramePanels::feature(ImagePanel* panel) {
  const auto place = std::find(panels_.begin(), panels_.end(), panel);
  if (place == panels_.end()) return;
  // A second click on the large picture enlarges the colour image again.
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
  panels_[featured_]->setLarge(featured_ != 0);
  int cell = 0;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    if (i == featured_) continue;
    panels_[i]->setLarge(false);
    const int x = left + (cell % 2) * (w - small_width);
    const int y = kMargin + large_height + kPanelGap + (cell / 2) * (small_height + kPanelGap);
    panels_[i]->setGeometry(x, y, small_width, small_height);
    ++cell;
  }
}

}  // namespace scantrove
