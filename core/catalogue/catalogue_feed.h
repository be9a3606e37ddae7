#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <unordered_set>
#include <utility>

#include "core/base/result.h"
#include "core/catalogue/catalogue_event.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

/// Reads what became of the catalogue: what others did since the last call. What this scan stored itself it
/// knows already; expect...() leaves that out. One thread, the database's.
class CatalogueFeed {
 public:
  /// The database outlives the feed.
  CatalogueFeed(ObjectDatabase& database, CataloguePosition from) : database_(database), position_(from) {}

  /// With its first view.
  void expectObject(ObjectId object) {
    own_objects_.insert(object);
    first_views_.insert(object);
  }
  void expectView(std::int64_t view) { own_views_.insert(view); }
  void expectMerge(const ObjectMerge& merge);

  /// Far below a millisecond when nothing happened, or when a user renamed or confirmed. On an error
  /// nothing is lost: the next call goes on.
  [[nodiscard]] Result<CatalogueEdits> follow();

  /// How far the catalogue was followed.
  [[nodiscard]] CataloguePosition position() const { return position_; }

  /// The states of all objects and the records of some, as they are now.
  [[nodiscard]] Result<CatalogueEdits> reread(std::span<const ObjectId> objects);

  /// A user undid a merge of these two (by what was followed).
  [[nodiscard]] bool areKeptApart(ObjectId a, ObjectId b) const {
    return kept_apart_.contains(std::minmax(a, b));
  }

 private:
  struct Following;
  /// Nothing of a hidden object.
  [[nodiscard]] Result<void> readRecord(ObjectId object, CatalogueEdits& edits);
  [[nodiscard]] Result<void> readObjects(CatalogueEdits& edits);
  [[nodiscard]] Result<void> readViews(CatalogueEdits& edits, std::int64_t& last_view);

  ObjectDatabase& database_;
  CataloguePosition position_;
  std::unordered_set<ObjectId> own_objects_;
  std::set<ObjectId> first_views_;  // of own objects, until they were followed
  std::unordered_set<std::int64_t> own_views_;
  std::multiset<std::pair<ObjectId, ObjectId>> own_merges_;  // into, from; until they were followed
  std::set<std::pair<ObjectId, ObjectId>> kept_apart_;       // smaller id first
};

}  // namespace scantrove
