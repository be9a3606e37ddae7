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

/// The rules of the catalogue: what it means to name, confirm, merge and delete objects, and to undo that. It
/// holds the state of all objects, or of those that an operation concerns. The database stores what the model
/// decides, in one transaction an operation; a running scan asks it ahead of the database; an opened session
/// reads its labels from it.
///
/// Nothing is ever deleted: deleted and merged objects are hidden. An operation that fails changes nothing.
class CatalogueModel {
 public:
  /// `place`: what messages call the catalogue, such as its file.
  explicit CatalogueModel(std::string place = "the catalogue") : place_(std::move(place)) {}

  // The state of objects.

  /// Adds an object, or replaces what is known of it.
  void put(ObjectState object) { objects_[object.id] = std::move(object); }
  /// A user undid a merge of these two: they are not merged again without a user.
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
  /// The visible object that `id` is now, after merges; none: it was deleted, or is not known.
  [[nodiscard]] ObjectId mergeRoot(ObjectId id) const;
  /// The object that has the views of `id`: as mergeRoot(), but hidden where that one was deleted. In a
  /// damaged file merges may form a circle or lead nowhere: then the last one.
  [[nodiscard]] ObjectId viewOwner(ObjectId id) const;
  [[nodiscard]] bool areKeptApart(ObjectId a, ObjectId b) const {
    return kept_apart_.contains(std::minmax(a, b));
  }
  [[nodiscard]] const std::set<std::pair<ObjectId, ObjectId>>& keptApart() const { return kept_apart_; }
  /// Whether the program may make one object of two visible ones: not when users settled both, nor when one
  /// of them undid that.
  [[nodiscard]] bool mayMerge(ObjectId a, ObjectId b) const;

  // Operations.

  /// Blanks around the name are dropped. Error: no name for an object (checkedLabelName), or another visible
  /// object has it.
  [[nodiscard]] Result<void> rename(ObjectId id, const std::string& name, NamedBy by);
  [[nodiscard]] Result<void> setConfirmed(std::span<const ObjectId> ids, bool confirmed);
  /// A user names what `id` is now, which confirms it. If another visible object has the name, `id` is merged
  /// into that one, unless `id` is settled: then nothing is done. Error: no name for an object; it was
  /// deleted.
  [[nodiscard]] Result<ObjectNaming> nameByUser(ObjectId id, const std::string& name);
  /// Undoes a naming, except for what users changed since. False: that was all of it.
  [[nodiscard]] Result<bool> revertNaming(const ObjectNaming& naming);
  /// Makes one object of two or more. The root is the one that a user named, then the confirmed one, then the
  /// oldest. It is confirmed if any of them was.
  [[nodiscard]] Result<ObjectMerge> merge(std::span<const ObjectId> ids);
  /// Each object gets back its name, or "name (2)" if the name is taken by now (as does restore), its mark,
  /// and the views that were stored for it.
  [[nodiscard]] Result<void> unmerge(const ObjectMerge& merge);
  [[nodiscard]] Result<void> remove(std::span<const ObjectId> ids);
  [[nodiscard]] Result<void> restore(std::span<const ObjectId> ids);
  /// Removes an object that was made for an operation which was undone: not if it is settled, hidden, or
  /// others are part of it. Whether it was removed.
  [[nodiscard]] Result<bool> withdraw(ObjectId made);

  /// What operations changed since the last call, in order.
  [[nodiscard]] std::vector<CatalogueChange> takeChanges() { return std::exchange(changes_, {}); }

 private:
  void apply(CatalogueChange::Kind kind, ObjectState after);
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
