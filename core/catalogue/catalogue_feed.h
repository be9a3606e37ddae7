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

/// Reads the changes of the catalogue by others since the last call. The scan's own changes are announced
/// with expect...() and left out. One thread, the database's.
class CatalogueFeed {
 public:
  /// The database outlives this.
  CatalogueFeed(ObjectDatabase& database, CataloguePosition from) : database_(database), position_(from) {}

  /// Also expects the object's first view.
  void expectObject(ObjectId object) {
    own_objects_.insert(object);
    first_views_.insert(object);
  }
  void expectView(std::int64_t view) { own_views_.insert(view); }
  void expectMerge(const ObjectMerge& merge);

  /// Takes far below a millisecond if nothing changed or a user only renamed or confirmed. Nothing is lost
  /// on an error: the next call continues.
  [[nodiscard]] Result<CatalogueEdits> readEdits();

  /// How far the catalogue was read.
  [[nodiscard]] CataloguePosition position() const { return position_; }

  /// The current states of all objects and classes, and the current records of some objects.
  [[nodiscard]] Result<CatalogueEdits> reread(std::span<const ObjectId> objects);

  /// Whether a user undid a merge of these two, among the changes read.
  [[nodiscard]] bool areKeptApart(ObjectId a, ObjectId b) const {
    return kept_apart_.contains(std::minmax(a, b));
  }

 private:
  struct ChangeFilter;
  /// Reads nothing for a hidden object.
  [[nodiscard]] Result<void> readRecord(ObjectId object, CatalogueEdits& edits);
  [[nodiscard]] Result<void> readObjects(CatalogueEdits& edits);
  [[nodiscard]] Result<void> readViews(CatalogueEdits& edits, std::int64_t& last_view);

  ObjectDatabase& database_;
  CataloguePosition position_;
  std::unordered_set<ObjectId> own_objects_;
  std::set<ObjectId> first_views_;  // of own objects, until they are read
  std::unordered_set<std::int64_t> own_views_;
  std::multiset<std::pair<ObjectId, ObjectId>> own_merges_;  // into, from; until they are read
  std::set<std::pair<ObjectId, ObjectId>> kept_apart_;       // smaller id first
};

}  // namespace scantrove
