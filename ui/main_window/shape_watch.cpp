#include "ui/main_window/shape_watch.h"

#include <QLocale>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "ui/main_window/main_window.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/models/region_selection.h"
#include "ui/panels/object_panel.h"

namespace scantrove {
namespace {

constexpr int kCheckAfter_ms = 1000;
/// Part of an object's voxels that must have changed before its points are looked at again.
constexpr double kVoxelsToCheck = 0.1;
/// With fewer points there is no shape yet.
constexpr std::size_t kLeastPoints = 30;

QString changeInWords(const ShapeChange& change, const RegionAppearance& confirmed,
                      const RegionAppearance& now) {
  const QString then_text = sizeInWords(confirmed.size_m), now_text = sizeInWords(now.size_m);
  switch (change.kind) {
    case ShapeChange::Kind::larger:
      return scantrove::ShapeWatch::tr("%1 times as large as when you confirmed it: %2, then %3")
          .arg(QLocale().toString(static_cast<double>(change.volume), 'f', 1), now_text, then_text);
    case ShapeChange::Kind::smaller:
      return scantrove::ShapeWatch::tr("Only %1 % as large as when you confirmed it: %2, then %3")
          .arg(QLocale().toString(std::lround(100 * change.volume)), now_text, then_text);
    case ShapeChange::Kind::other_colors:
      break;
  }
  return scantrove::ShapeWatch::tr("Most of it has other colours than when you confirmed it");
}

}  // namespace

ShapeWatch::ShapeWatch(MainWindow& window) : QObject(&window), window_(window) {
  connect(&window_.editor(), &CatalogueEditor::opened, this, &ShapeWatch::clear);
  connect(&window_.editor(), &CatalogueEditor::changed, this, &ShapeWatch::follow);
  connect(&window_.controller(), &ScanController::opening, this, &ShapeWatch::clear);
  connect(&window_.regions().selection(), &RegionSelection::infosChanged, this, &ShapeWatch::schedule);
  connect(window_.parts().objects, &ObjectPanel::confirmed, this, &ShapeWatch::accept);
  window_.controller().bridge().on<ReviewOpened>(this, [this] {
    is_review_ = true;
    schedule();
  });
  timer_.setSingleShot(true);
  timer_.setInterval(kCheckAfter_ms);
  connect(&timer_, &QTimer::timeout, this, &ShapeWatch::check);
}

void ShapeWatch::clear() {
  watched_.clear();
  to_begin_.clear();
  is_review_ = false;
  points_ = 0;
  window_.model().setChanged({});
}

void ShapeWatch::follow(const CatalogueChanges& changes) {
  for (const CatalogueChange& change : changes.changes) {
    if (change.of_class) continue;
    // Names that are given to regions confirm, too.
    if (change.after.confirmed && !change.before.confirmed && !watched_.contains(change.object()))
      to_begin_.insert(change.object());
    if (change.kind == CatalogueChange::Kind::unconfirmed) {
      watched_.erase(change.object());
      to_begin_.erase(change.object());
    }
  }
  schedule();
}

void ShapeWatch::accept(const std::vector<ObjectId>& objects) {
  for (const ObjectId object : objects) {
    watched_.erase(object);
    to_begin_.insert(object);
  }
  check();
}

void ShapeWatch::schedule() {
  if (!timer_.isActive() && !window_.onStartPage()) timer_.start();
}

std::map<ObjectId, ShapeWatch::State> ShapeWatch::statesOfConfirmed() const {
  std::map<ObjectId, State> states;
  for (const RegionInfo& info : window_.regions().selection().infos()) {
    const ObjectRecord* const record = info.object ? window_.model().record(info.object) : nullptr;
    if (record == nullptr || !record->confirmed) continue;
    State& state = states[info.object];
    state.regions.insert(info.region);
    state.voxels += info.voxels;
  }
  return states;
}

bool ShapeWatch::differs(ObjectId object, const State& state) const {
  const auto known = watched_.find(object);
  if (known == watched_.end()) return is_review_ || to_begin_.contains(object);
  const State& checked = known->second.checked;
  return checked.regions != state.regions || static_cast<double>(std::abs(state.voxels - checked.voxels)) >
                                                 kVoxelsToCheck * static_cast<double>(checked.voxels);
}

void ShapeWatch::check() {
  if (window_.onStartPage()) return;
  const CloudChunks& cloud = window_.parts().scene->view()->scene().cloud();
  // The points of a scan that was opened come in parts.
  if (const std::size_t points = cloud.pointCount(); is_review_ && points != std::exchange(points_, points))
    return timer_.start();
  std::map<ObjectId, State> states = statesOfConfirmed();
  std::erase_if(states, [this](const auto& entry) { return !differs(entry.first, entry.second); });
  if (!states.empty()) {
    const auto points = cloud.pointsOfRegions(1);
    for (auto& [object, state] : states) {
      std::vector<AppearancePoint> of_object;
      for (const RegionId region : state.regions) {
        if (const auto found = points.find(region); found != points.end())
          of_object.insert(of_object.end(), found->second.begin(), found->second.end());
      }
      if (of_object.size() < kLeastPoints) continue;
      const RegionAppearance now = appearanceOf(of_object);
      const auto [entry, is_first] = watched_.try_emplace(object, Watched{now, now, {}});
      entry->second.now = now;
      entry->second.checked = std::move(state);
      to_begin_.erase(object);
    }
  }
  showChanges();
}

void ShapeWatch::showChanges() {
  std::map<ObjectId, QString> changes;
  for (const auto& [object, watched] : watched_) {
    const ObjectRecord* const record = window_.model().record(object);
    if (record == nullptr || !record->confirmed) continue;
    if (const auto change = changeOf(watched.confirmed, watched.now))
      changes.emplace(object, changeInWords(*change, watched.confirmed, watched.now));
  }
  window_.model().setChanged(std::move(changes));
}

}  // namespace scantrove
