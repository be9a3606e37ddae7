#include "core/catalogue/catalogue_feed.h"

#include <algorithm>
#include <vector>

namespace scantrove {

/// Sorts changes of the database by what they need. The scan's own changes are taken out.
struct CatalogueFeed::ChangeFilter {
  const CatalogueFeed& feed;
  std::set<ObjectId> first_views = feed.first_views_;                          ///< still expected
  std::multiset<std::pair<ObjectId, ObjectId>> own_merges = feed.own_merges_;  ///< still expected
  std::vector<std::int64_t> own_first_views = {};
  std::vector<CatalogueChange> changes = {};  ///< by others

  void operator()(const CatalogueChange& change) {
    if (!isOwn(change)) changes.push_back(change);
  }

 private:
  bool isOwn(const CatalogueChange& change) {
    switch (change.kind) {
      case CatalogueChange::Kind::added:
        return feed.own_objects_.contains(change.object());
      case CatalogueChange::Kind::view_added:
        if (first_views.erase(change.object()) == 0) return feed.own_views_.contains(change.view);
        own_first_views.push_back(change.view);  // stored with the object
        return true;
      case CatalogueChange::Kind::merged: {
        const auto own = own_merges.find({change.mergeTarget(), change.object()});
        if (own == own_merges.end()) return false;
        own_merges.erase(own);
        return true;
      }
      default:
        return false;
    }
  }
};

void CatalogueFeed::expectMerge(const ObjectMerge& merge) {
  for (const ObjectId from : merge.from) own_merges_.emplace(merge.into, from);
}

Result<CatalogueEdits> CatalogueFeed::readEdits() {
  const Result<CatalogueChanges> changes = database_.changesAfter(position_.event);
  if (!changes) return fail(changes.error());
  ChangeFilter filter{*this};
  for (const CatalogueChange& change : changes->changes) filter(change);
  CatalogueEdits edits;
  edits.changes = std::move(filter.changes);
  CataloguePosition now{changes->last_event, position_.view};
  const auto needsObjects = [](const CatalogueChange& change) {
    return change.movesViews() || change.of_class.has_value();
  };
  if (std::ranges::any_of(edits.changes, needsObjects)) SCANTROVE_TRY(readObjects(edits));
  std::set<ObjectId> changed;
  bool has_views = false;
  for (const CatalogueChange& change : edits.changes) {
    if (change.object()) changed.insert(change.object());
    if (change.mergeTarget()) changed.insert(change.mergeTarget());
    has_views = has_views || change.kind == CatalogueChange::Kind::view_added;
  }
  for (const ObjectId object : changed) SCANTROVE_TRY(readRecord(object, edits));
  own_views_.insert(filter.own_first_views.begin(), filter.own_first_views.end());
  if (has_views) SCANTROVE_TRY(readViews(edits, now.view));
  // Everything is read: nothing can fail from here on.
  for (const CatalogueChange& change : edits.changes) {
    if (change.kind == CatalogueChange::Kind::unmerged)
      kept_apart_.insert(std::minmax(change.object(), change.mergeTarget()));
  }
  first_views_ = std::move(filter.first_views);
  own_merges_ = std::move(filter.own_merges);
  std::erase_if(own_views_, [&](std::int64_t view) { return view <= now.view; });
  position_ = now;
  return edits;
}

Result<CatalogueEdits> CatalogueFeed::reread(std::span<const ObjectId> objects) {
  CatalogueEdits edits;
  SCANTROVE_TRY(readObjects(edits));
  for (const ObjectId object : objects) SCANTROVE_TRY(readRecord(object, edits));
  return edits;
}

Result<void> CatalogueFeed::readRecord(ObjectId object, CatalogueEdits& edits) {
  Result<ObjectRecord> record = database_.object(object);
  if (record) {
    edits.records.push_back(std::move(*record));
    return {};
  }
  // It cannot be read, perhaps because it is hidden.
  const Result<ObjectId> root = database_.mergeRoot(object);
  return root && *root != object ? Result<void>() : fail(record.error());
}

Result<void> CatalogueFeed::readObjects(CatalogueEdits& edits) {
  const Result<CatalogueModel> model = database_.model();
  if (!model) return fail(model.error());
  for (const auto& [id, object] : model->objects()) edits.objects.push_back(object);
  edits.classes = model->classes();
  return {};
}

Result<void> CatalogueFeed::readViews(CatalogueEdits& edits, std::int64_t& last_view) {
  return moveInto(last_view,
                  database_.views().forEachDescriptor(last_view, [&](const StoredDescriptor& view) {
                    if (!own_views_.contains(view.view)) edits.views.push_back(view);
                  }));
}

}  // namespace scantrove
