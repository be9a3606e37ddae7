#include "ui/main_window/scene_names.h"

#include <QAction>
#include <QSettings>
#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ui/main_window/scene_pane.h"
#include "ui/models/region_selection.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/regions_in_picture.h"
#include "ui/panels/scene_overlay.h"

namespace scantrove {
namespace {

const QString kNamesKey = QStringLiteral("view/names");
constexpr int kFindInterval_ms = 250;
constexpr int kLeastPixels = 40;  ///< of a region that gets a name

}  // namespace

SceneNames::SceneNames(RegionSelection& selection, ScenePane& scene, FramePanels& frames, QObject* parent)
    : QObject(parent),
      selection_(selection),
      scene_(scene),
      frames_(frames),
      action_(new QAction(tr("&Names"), this)) {
  action_->setCheckable(true);
  action_->setChecked(QSettings().value(kNamesKey, true).toBool());
  action_->setShortcut(QKeySequence(tr("Shift+N")));
  action_->setToolTip(tr("Show the names of the regions in the 3D view (%1)")
                          .arg(action_->shortcut().toString(QKeySequence::NativeText)));
  find_timer_.setSingleShot(true);
  connect(&find_timer_, &QTimer::timeout, this, &SceneNames::findAnchors);
  connect(action_, &QAction::toggled, this, [this](bool on) {
    QSettings().setValue(kNamesKey, on);
    on ? findAnchors() : place();
  });
  connect(&selection_, &RegionSelection::infosChanged, this, &SceneNames::updateNames);
  connect(&selection_, &RegionSelection::selectionChanged, this, &SceneNames::place);
  // Queued, so that it does not delay the display of the picture.
  connect(
      scene_.view(), &SceneView::drawn, this,
      [this] {
        place();
        if (!find_timer_.isActive()) find_timer_.start(kFindInterval_ms);
      },
      Qt::QueuedConnection);
  connect(scene_.view(), &SceneView::cleared, this, [this] {
    anchors_world_.clear();
    place();
  });
}

void SceneNames::updateNames() {
  std::map<RegionId, QString> names;
  for (const RegionInfo& info : selection_.infos()) {
    if (!info.name().empty() && !info.note.background && !info.note.rejected)
      names[info.region] = QString::fromStdString(info.name());
  }
  if (names == names_) return;
  names_ = std::move(names);
  frames_.setNames(names_);
  find_timer_.start(0);
}

void SceneNames::findAnchors() {
  anchors_world_.clear();
  if (action_->isChecked() && !names_.empty()) {
    SceneView* const view = scene_.view();
    std::set<RegionId> regions;
    for (const auto& [region, name] : names_) regions.insert(region);
    const cv::Mat& ids = view->regionIds();
    for (const auto& [region, seen] : regionsInPicture(ids, regions, kLeastPixels)) {
      const QPointF position((seen.anchor_px.x + 0.5) * view->width() / ids.cols,
                             (seen.anchor_px.y + 0.5) * view->height() / ids.rows);
      if (const RegionPoint at = view->at(position); at.point_world) anchors_world_[region] = *at.point_world;
    }
  }
  place();
}

void SceneNames::place() {
  std::vector<SceneOverlay::Name> shown;
  if (action_->isChecked()) {
    for (const auto& [region, anchor] : anchors_world_) {
      const auto name = names_.find(region);
      const std::optional<QPointF> at = scene_.view()->positionOf(anchor);
      if (name != names_.end() && at) shown.push_back({*at, name->second, selection_.isSelected(region)});
    }
  }
  // Selected names are placed first.
  std::stable_sort(shown.begin(), shown.end(),
                   [](const auto& a, const auto& b) { return a.is_selected && !b.is_selected; });
  scene_.overlay()->setNames(std::move(shown));
}

}  // namespace scantrove
