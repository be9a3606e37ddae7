#include "core/scan/catalogue_mirror.h"

#include <variant>
#include <vector>

namespace scantrove {
namespace {
/// Room for what a long scan adds, so that nothing is copied in the middle of it.
constexpr int kViewsOfAScan = 2048;
}  // namespace

/// What some changes ask for.
struct CatalogueMirror::Effects {
  std::set<ObjectId> changed;  ///< whose records are to be read again
  bool holders = false;        ///< views have gone from one object to another, or to none
  bool views = false;          ///< there are more
  std::vector<std::pair<ObjectId, ObjectId>> unmerged;

  std::vector<ObjectId> added;

  void operator()(const change::Added& e) {
    changed.insert(e.object);
    added.push_back(e.object);
  }
  void operator()(const change::ViewAdded& e) {
    changed.insert(e.object);
    views = true;
  }
  void operator()(const change::Renamed& e) { changed.insert(e.object); }
  void operator()(const change::Confirmed& e) { changed.insert(e.object); }
  void operator()(const change::Removed& e) { regroup(e.object); }
  void operator()(const change::Restored& e) { regroup(e.object); }
  void operator()(const change::Merged& e) {
    regroup(e.into);
    regroup(e.from);
  }
  void operator()(const change::Unmerged& e) {
    regroup(e.into);
    regroup(e.from);
    unmerged.push_back(std::minmax(e.into, e.from));
  }

 private:
  void regroup(ObjectId object) {
    changed.insert(object);
    holders = true;
  }
};

Result<void> CatalogueMirror::load() {
  // What happens while this reads is told again by the changes after this one.
  SCANTROVE_TRY(moveInto(last_event_, database_.lastEvent()));
  Result<std::vector<ObjectRecord>> objects = database_.objects();
  if (!objects) return fail(objects.error());
  records_.reserve(objects->size());
  for (ObjectRecord& record : *objects) records_.emplace(record.id, std::move(record));
  SCANTROVE_TRY(loadHolders());
  const Result<int> views = database_.viewCount();
  if (!views) return fail(views.error());
  detector_.reserve(*views + kViewsOfAScan);
  return loadViews();
}

Result<void> CatalogueMirror::loadHolders() {
  const Result<std::vector<ObjectHolder>> holders = database_.holders();
  if (!holders) return fail(holders.error());
  for (const ObjectHolder& entry : *holders) detector_.setHolder(entry);
  return {};
}

Result<void> CatalogueMirror::loadViews() {
  return moveInto(last_view_, database_.forEachDescriptor(last_view_, [this](const StoredDescriptor& view) {
    detector_.add(view);
    last_view_ = view.view;
  }));
}

Result<void> CatalogueMirror::follow() {
  const Result<CatalogueChanges> news = database_.changesAfter(last_event_);
  if (!news) return fail(news.error());
  Effects effects;
  for (const CatalogueChange& change : news->changes) std::visit(effects, change);
  for (const ObjectId object : effects.added) detector_.setHolder({object, object});
  if (effects.holders) SCANTROVE_TRY(loadHolders());
  for (const ObjectId object : effects.changed) SCANTROVE_TRY(readRecord(object));
  if (effects.views) SCANTROVE_TRY(loadViews());
  kept_apart_.insert(effects.unmerged.begin(), effects.unmerged.end());
  last_event_ = news->last_event;
  return {};
}

Result<void> CatalogueMirror::readRecord(ObjectId object) {
  if (holderOf(object) != object) {
    records_.erase(object);
    return {};
  }
  Result<ObjectRecord> record = database_.object(object);
  if (!record) {
    // Hidden just now? Then the next changes say so.
    const Result<ObjectId> holder = database_.resolve(object);
    return holder && *holder != object ? Result<void>{} : fail(record.error());
  }
  records_[object] = std::move(*record);
  return {};
}

const ObjectRecord* CatalogueMirror::record(ObjectId object) const {
  const auto found = records_.find(object);
  return found == records_.end() ? nullptr : &found->second;
}

void CatalogueMirror::noteAdded(const ObjectRecord& record) {
  records_[record.id] = record;
  detector_.setHolder({record.id, record.id});
}

}  // namespace scantrove
