#include "ui/main_window/selection_link.h"

#include <QScopedValueRollback>
#include <algorithm>

#include "ui/models/region_selection.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"

namespace scantrove {

SelectionLink::SelectionLink(RegionSelection& regions, ObjectPanel& objects, FramePanels& frames,
                             QObject* parent)
    : QObject(parent), regions_(regions), objects_(objects), frames_(frames) {
  connect(&objects_, &ObjectPanel::selectionChanged, this, &SelectionLink::followList);
  connect(&regions_, &RegionSelection::selectionChanged, this, [this] {
    of_regions_ = objectsOfRegions();
    followRegions();
  });
  // A selected region may become an object.
  connect(&regions_, &RegionSelection::infosChanged, this, [this] {
    std::vector<ObjectId> now = objectsOfRegions();
    if (now == of_regions_) return;
    of_regions_ = std::move(now);
    if (!of_regions_.empty()) followRegions();
  });
}

std::vector<ObjectId> SelectionLink::objectsOfRegions() const {
  std::vector<ObjectId> objects;
  for (const RegionId region : regions_.selected()) {
    const RegionInfo* const info = regions_.info(region);
    if (info != nullptr && info->object && std::ranges::find(objects, info->object) == objects.end())
      objects.push_back(info->object);
  }
  std::ranges::sort(objects);
  return objects;
}

void SelectionLink::followList(const std::vector<ObjectId>& objects) {
  frames_.setSelected({objects.begin(), objects.end()});
  if (is_following_ || objects.empty()) return;
  const QScopedValueRollback following(is_following_, true);
  std::vector<RegionId> regions;
  for (const RegionInfo& region : regions_.infos()) {
    if (region.object && std::ranges::find(objects, region.object) != objects.end())
      regions.push_back(region.region);
  }
  // Also without regions: keys would change what is no longer meant.
  regions_.select(regions);
}

void SelectionLink::followRegions() {
  if (is_following_) return;
  const QScopedValueRollback following(is_following_, true);
  if (objects_.list()->selection() != of_regions_) objects_.list()->select(of_regions_);
}

}  // namespace scantrove
