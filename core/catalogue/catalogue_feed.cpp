#include "core/catalogue/catalogue_feed.h"

#include <variant>
#include <vector>

namespace scantrove {

/// What some changes ask for.
struct CatalogueFeed::Effects {
  const CatalogueFeed& feed;
  std::set<ObjectId> first_views = feed.first_views_;                          ///< that are still to come
  std::multiset<std::pair<ObjectId, ObjectId>> own_merges = feed.own_merges_;  ///< likewise
  std::set<ObjectId> changed = {};  ///< whose records are to be read again
  std::vector<ObjectId> regrouped = {};
  bool merge_roots = false;  ///< views have gone from one object to another, or to none
  bool views = false;        ///< there are more
  std::vector<std::int64_t> own_first_views = {};
  std::vector<ObjectId> added = {};
  std::vector<std::pair<ObjectId, ObjectId>> unmerged = {};

  void operator()(const change::Added& e) {
    if (feed.own_objects_.contains(e.object)) return;
    changed.insert(e.object);
    added.push_back(e.object);
  }
  void operator()(const change::ViewAdded& e) {
    if (first_views.erase(e.object) > 0) {  // stored with the object
      own_first_views.push_back(e.view);
      return;
    }
    if (feed.own_views_.contains(e.view)) return;
    changed.insert(e.object);
    views = true;
  }
  void operator()(const change::Renamed& e) { changed.insert(e.object); }
  void operator()(const change::Confirmed& e) { changed.insert(e.object); }
  void operator()(const change::ViewsDiscarded& e) { changed.insert(e.object); }
  void operator()(const change::Removed& e) { regroup(e.object); }
  void operator()(const change::Restored& e) { regroup(e.object); }
  void operator()(const change::Merged& e) {
    if (const auto own = own_merges.find({e.into, e.from}); own != own_merges.end()) {
      own_merges.erase(own);
      return;
    }
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
    regrouped.push_back(object);
    merge_roots = true;
  }
};

void CatalogueFeed::expectMerge(const ObjectMerge& merge) {
  for (const ObjectId from : merge.from) own_merges_.emplace(merge.into, from);
}

Result<CatalogueEdits> CatalogueFeed::follow() {
  const Result<CatalogueChanges> news = database_.changesAfter(position_.event);
  if (!news) return fail(news.error());
  Effects effects{*this};
  for (const CatalogueChange& change : news->changes) std::visit(effects, change);
  CatalogueEdits edits;
  CataloguePosition now{news->last_event, position_.view};
  if (effects.merge_roots) SCANTROVE_TRY(moveInto(edits.merge_roots, database_.mergeRoots()));
  for (const ObjectId object : effects.changed) SCANTROVE_TRY(readRecord(object, edits));
  own_views_.insert(effects.own_first_views.begin(), effects.own_first_views.end());
  if (effects.views) SCANTROVE_TRY(readViews(edits, now.view));
  edits.added = std::move(effects.added);
  edits.unmerged = std::move(effects.unmerged);
  edits.regrouped = std::move(effects.regrouped);
  // All was read: from here on nothing fails.
  kept_apart_.insert(edits.unmerged.begin(), edits.unmerged.end());
  first_views_ = std::move(effects.first_views);
  own_merges_ = std::move(effects.own_merges);
  std::erase_if(own_views_, [&](std::int64_t view) { return view <= now.view; });
  position_ = now;
  return edits;
}

Result<CatalogueEdits> CatalogueFeed::reread(std::span<const ObjectId> objects) {
  CatalogueEdits edits;
  SCANTROVE_TRY(moveInto(edits.merge_roots, database_.mergeRoots()));
  for (const ObjectId object : objects) SCANTROVE_TRY(readRecord(object, edits));
  return edits;
}

Result<void> CatalogueFeed::readRecord(ObjectId object, CatalogueEdits& edits) {
  Result<ObjectRecord> record = database_.object(object);
  if (record) {
    edits.records.push_back(std::move(*record));
    return {};
  }
  // It cannot be read because it is hidden?
  const Result<ObjectId> root = database_.resolve(object);
  if (!root || *root == object) return fail(record.error());
  edits.hidden.push_back(object);
  return {};
}

Result<void> CatalogueFeed::readViews(CatalogueEdits& edits, std::int64_t& last_view) {
  return moveInto(last_view, database_.forEachDescriptor(last_view, [&](const StoredDescriptor& view) {
    if (!own_views_.contains(view.view)) edits.views.push_back(view);
  }));
}

}  // namespace scantrove
