#pragma once
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// The rules of the catalogue for naming, confirming, merging and deleting objects, and for undoing that.
/// It holds the states of all objects, or of those that an operation needs. The database stores the model's
/// decisions, one transaction for each operation. A running scan asks the model ahead of the database, and
/// an opened session reads its labels from it.
///
/// Nothing is ever deleted: deleted and merged objects are hidden. A failed operation changes nothing.
class CatalogueModel {
 public:
  /// `place`: how messages call the catalogue, such as its file.
  explicit CatalogueModel(std::string place = "the catalogue") : place_(std::move(place)) {}

  // The state of objects.

  /// Adds an object, or replaces its state.
  void put(ObjectState object) { objects_[object.id] = std::move(object); }
  /// A user undid a merge of these two: only a user may merge them again.
  void keepApart(ObjectId a, ObjectId b) { kept_apart_.insert(std::minmax(a, b)); }
  [[nodiscard]] const std::map<ObjectId, ObjectState>& objects() const { return objects_; }
  /// Null: no such object.
  [[nodiscard]] const ObjectState* find(ObjectId id) const;
  /// Null: no such object, or a hidden one.
  [[nodiscard]] const ObjectState* visible(ObjectId id) const;
  /// The visible object of that name, or null.
  [[nodiscard]] const ObjectState* named(const std::string& name) const;
  /// Error: no such object.
  [[nodiscard]] Result<ObjectState> known(ObjectId id) const;
  /// Error: no such object; it was deleted; it was merged (says into which).
  [[nodiscard]] Result<ObjectState> shown(ObjectId id) const;
  /// The visible merge root of `id`; none: deleted or unknown.
  [[nodiscard]] ObjectId mergeRoot(ObjectId id) const;
  /// The object that has the views of `id`: its merge root, even if hidden. Where merges in a damaged file
  /// are circular or dangling, the last one reached.
  [[nodiscard]] ObjectId viewOwner(ObjectId id) const;
  [[nodiscard]] bool areKeptApart(ObjectId a, ObjectId b) const {
    return kept_apart_.contains(std::minmax(a, b));
  }
  [[nodiscard]] const std::set<std::pair<ObjectId, ObjectId>>& keptApart() const { return kept_apart_; }
  /// Whether the program may merge two visible objects: not if users settled both, or a user undid that
  /// merge.
  [[nodiscard]] bool mayMerge(ObjectId a, ObjectId b) const;
  /// Whether the program may remove views of the object that it stored: not if a user settled it, and not if
  /// it is hidden.
  [[nodiscard]] bool mayDiscardViews(ObjectId id) const {
    const ObjectState* object = visible(id);
    return object != nullptr && !isSettled(*object);
  }

  // Operations.

  /// Surrounding blanks are dropped. Error: not a valid name (checkedLabelName), or another visible object
  /// has it.
  [[nodiscard]] Result<void> rename(ObjectId id, const std::string& name, NamedBy by);
  [[nodiscard]] Result<void> setConfirmed(std::span<const ObjectId> ids, bool confirmed);
  /// A user names the merge root of `id`, which confirms it. If another visible object has the name, `id`
  /// is merged into that one, unless `id` is settled: then nothing is done. Error: not a valid name; the
  /// object was deleted.
  [[nodiscard]] Result<ObjectNaming> nameByUser(ObjectId id, const std::string& name);
  /// Undoes a naming, except for later changes by users. False: there were such changes.
  [[nodiscard]] Result<bool> revertNaming(const ObjectNaming& naming);
  /// Merges two or more objects. The root is the one that a user named, else the confirmed one, else the
  /// oldest. It is confirmed if any of them was.
  [[nodiscard]] Result<ObjectMerge> merge(std::span<const ObjectId> ids);
  /// Each object gets back its name (or "name (2)" if taken by now, as in restore), its confirmation, and
  /// the views that were stored for it.
  [[nodiscard]] Result<void> unmerge(const ObjectMerge& merge);
  [[nodiscard]] Result<void> remove(std::span<const ObjectId> ids);
  [[nodiscard]] Result<void> restore(std::span<const ObjectId> ids);
  /// Removes an object that was made for an undone operation, unless it is settled, hidden, or others are
  /// merged into it. Returns whether it was removed.
  [[nodiscard]] Result<bool> withdraw(ObjectId made);

  /// Changes by operations since the last call, in order.
  [[nodiscard]] std::vector<CatalogueChange> takeChanges() { return std::exchange(changes_, {}); }

 private:
  void apply(CatalogueChange::Kind kind, const ObjectState& after);
  void applyConfirmed(ObjectId id, bool confirmed);
  void applyName(ObjectId id, const std::string& name, NamedBy by);
  void applyHidden(ObjectId id);
  /// Shows a hidden object again.
  void applyShown(CatalogueChange::Kind kind, ObjectId id);
  [[nodiscard]] std::string called(const ObjectState& object) const;

  std::string place_;
  std::map<ObjectId, ObjectState> objects_;
  std::set<std::pair<ObjectId, ObjectId>> kept_apart_;  // smaller id first
  std::vector<CatalogueChange> changes_;
};

}  // namespace scantrove
