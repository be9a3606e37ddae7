#include "ui/main_window/coverage_guide.h"

#include <QAction>
#include <QSettings>
#include <algorithm>
#include <map>
#include <utility>

#include "ui/main_window/scene_pane.h"
#include "ui/models/object_list_model.h"
#include "ui/models/region_selection.h"
#include "ui/panels/scene_overlay.h"
#include "ui/theme/icon.h"

namespace scantrove {
namespace {

const QString kGuideKey = QStringLiteral("view/guide");
/// Range of distances for viewing an object.
constexpr float kNearest_m = 0.4F;
constexpr float kFarthest_m = 1.2F;
constexpr int kBoxInterval_ms = 1000;  // the box is updated at this interval

}  // namespace

CoverageGuide::CoverageGuide(RegionSelection& selection, ScenePane& scene, ObjectListModel& objects,
                             QObject* parent)
    : QObject(parent),
      selection_(selection),
      scene_(scene),
      objects_(objects),
      action_(new QAction(icon(QStringLiteral("guide")), tr("Show where to m&ove"), this)) {
  action_->setCheckable(true);
  action_->setChecked(QSettings().value(kGuideKey, true).toBool());
  action_->setShortcut(QKeySequence(tr("Shift+G")));
  action_->setToolTip(
      tr("Show with an arrow where to move the camera to see the unseen sides of the selection (%1)")
          .arg(action_->shortcut().toString(QKeySequence::NativeText)));
  connect(action_, &QAction::toggled, this, [this](bool on) {
    QSettings().setValue(kGuideKey, on);
    update();
  });
  connect(&selection_, &RegionSelection::selectionChanged, this, [this] {
    since_box_.invalidate();
    update();
  });
  connect(scene_.view(), &SceneView::drawn, this, &CoverageGuide::placeLabel, Qt::QueuedConnection);
}

void CoverageGuide::beginScan(bool is_one_object) {
  is_one_object_ = is_one_object;
  camera_.reset();
  update();
}

void CoverageGuide::showSnapshot(const ScanSnapshot& snapshot) {
  const bool is_scanning = snapshot.state == ScanState::scanning || snapshot.state == ScanState::paused;
  camera_.reset();
  if (is_scanning && snapshot.pose.usable())
    camera_ = snapshot.pose.T_world_camera.translation().cast<float>();
  showObjects();
  update();
}

void CoverageGuide::showObjects() {
  std::map<ObjectId, ViewCoverage> seen_from;
  for (const RegionInfo& info : selection_.infos()) {
    if (info.object) seen_from[info.object].add(info.seen_from);
  }
  const SideAxes axes = scene_.view()->scene().sideAxes();
  if (seen_from == objects_seen_from_ && axes == axes_of_objects_) return;
  std::map<ObjectId, SeenSides> sides;
  for (const auto& [object, coverage] : seen_from) {
    const auto before = objects_seen_from_.find(object);
    const bool is_known =
        axes == axes_of_objects_ && before != objects_seen_from_.end() && before->second == coverage;
    sides[object] = is_known ? sides_of_objects_[object] : sidesOf(coverage, axes);
  }
  objects_seen_from_ = std::move(seen_from);
  axes_of_objects_ = axes;
  sides_of_objects_ = sides;
  objects_.setSeenSides(std::move(sides));
}

std::vector<RegionId> CoverageGuide::guided() const {
  const auto& selected = selection_.selected();
  const RegionInfos& infos = selection_.infos();
  if (!selected.empty() || !is_one_object_ || infos.empty()) return {selected.begin(), selected.end()};
  return {std::ranges::max_element(infos, {}, &RegionInfo::voxels)->region};
}

void CoverageGuide::update() {
  ViewCoverage coverage;
  const std::vector<RegionId> regions = guided();
  bool is_object = !regions.empty();
  for (const RegionId region : regions) {
    const RegionInfo* const info = selection_.info(region);
    is_object = is_object && info != nullptr && !info->note.background && !info->note.rejected;
    if (is_object) coverage.add(info->seen_from);
  }
  shown_.reset();
  const bool had_arrow = target_direction_.has_value();
  target_direction_.reset();
  if (is_object) {
    shown_ = sidesOf(coverage, scene_.view()->scene().sideAxes());
    showArrow(*shown_);
  }
  scene_.overlay()->setSeenSides(shown_, shown_ ? sidesInWords(*shown_) : QString());
  if (!target_direction_) scene_.view()->scene().hideArrow();
  if (had_arrow || target_direction_) scene_.view()->drawing().redraw();
  placeLabel();
}

void CoverageGuide::showArrow(const SeenSides& seen) {
  if (!camera_ || !action_->isChecked()) return;
  if (!since_box_.isValid() || since_box_.hasExpired(kBoxInterval_ms)) findBox();
  if (box_.isEmpty()) return;
  LabelCloudScene& scene = scene_.view()->scene();
  const SideAxes axes = scene.sideAxes();
  const Eigen::Vector3f from = *camera_ - box_.center();
  target_direction_ = nextDirection(seen, axes, from);
  const float level = (from - from.dot(axes.up) * axes.up).norm();
  if (!target_direction_ || !(level > 0.02F)) return target_direction_.reset();
  const float distance_m = std::clamp(from.norm(), kNearest_m, kFarthest_m);
  const Eigen::Vector3f to = distance_m * *target_direction_;
  head_ = box_.center() + to;
  scene.showArrow(box_.center(), from.normalized() * distance_m, to);
}

void CoverageGuide::findBox() {
  const std::vector<RegionId> regions = guided();
  box_ = scene_.view()->scene().cloud().boundsOf({regions.begin(), regions.end()});
  since_box_.start();
}

void CoverageGuide::placeLabel() {
  SceneView* const view = scene_.view();
  const float aspect = static_cast<float>(view->width()) / static_cast<float>(std::max(1, view->height()));
  std::optional<Eigen::Vector2f> position;
  if (target_direction_) position = view->scene().viewpoint().positionOf(head_, aspect);
  std::optional<QPointF> in_view;
  if (position && position->cwiseAbs().maxCoeff() <= 1) {
    in_view = QPointF((1 + static_cast<double>(position->x())) * view->width() / 2,
                      (1 - static_cast<double>(position->y())) * view->height() / 2);
  }
  scene_.overlay()->setMark(in_view, tr("Move here"));
}

}  // namespace scantrove
