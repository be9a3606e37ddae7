#pragma once
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/class_edits.h"
#include "core/catalogue/class_table.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// The rules of the catalogue for naming, classifying, confirming, merging and deleting objects, for its list
/// of classes, and for undoing that.
/// It holds the states of all objects, or of those that an operation needs. The database stores the model's
/// decisions, one transaction for each operation. A running scan asks the model ahead of the database, and
/// an opened session reads its labels from it.
///
/// Nothing is ever deleted: deleted and merged objects and classes are hidden. A failed operation changes
/// nothing. It has more than thirty functions, because all these rules must be in one place.
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

  // The state of classes.

  /// Adds a class, or replaces its state.
  void putClass(ObjectClass object_class) { classes_.put(std::move(object_class)); }
  void putClasses(ClassTable classes) { classes_ = std::move(classes); }
  [[nodiscard]] const ClassTable& classes() const { return classes_; }
  /// The merge root of the object's class; null: it has none.
  [[nodiscard]] const ObjectClass* classOf(const Classification& classification) const {
    return classes_.rootOf(classification.class_id);
  }
  /// The answers to what its class asks.
  [[nodiscard]] AttributeValues answersOf(const Classification& classification) const;
  /// Whether a visible object has the class, or one that is merged into it.
  [[nodiscard]] bool isUsed(ClassId root) const;

  // Operations on objects.

  /// Surrounding blanks are dropped. Error: not a valid name (checkedLabelName), or another visible object
  /// has it.
  [[nodiscard]] Result<void> rename(ObjectId id, const std::string& name, NamedBy by);
  [[nodiscard]] Result<void> setConfirmed(std::span<const ObjectId> ids, bool confirmed);
  /// A user names the merge root of `id`, which confirms it. If another visible object has the name, `id`
  /// is merged into that one, unless `id` is settled: then nothing is done. Error: not a valid name; the
  /// object was deleted. The object gets the class of that name, which is made if there is none. Without
  /// `class_name` an object without class gets the known class that its name suggests
  /// (ClassTable::suggestedBy).
  [[nodiscard]] Result<ObjectNaming> nameByUser(ObjectId id, const std::string& name,
                                                const std::string& class_name = {});
  /// Undoes a naming, except for later changes by users. False: there were such changes.
  [[nodiscard]] Result<bool> revertNaming(const ObjectNaming& naming);
  /// Merges two or more objects. The root is the one that a user named, else the confirmed one, else the
  /// oldest. It is confirmed if any of them was, and takes the class of another if it has none.
  [[nodiscard]] Result<ObjectMerge> merge(std::span<const ObjectId> ids);
  /// Each object gets back its name (or "name (2)" if taken by now, as in restore), its confirmation, and
  /// the views that were stored for it.
  [[nodiscard]] Result<void> unmerge(const ObjectMerge& merge);
  [[nodiscard]] Result<void> remove(std::span<const ObjectId> ids);
  [[nodiscard]] Result<void> restore(std::span<const ObjectId> ids);
  /// Removes an object that was made for an undone operation, unless it is settled, hidden, or others are
  /// merged into it. Returns whether it was removed.
  [[nodiscard]] Result<bool> withdraw(ObjectId made);

  /// None: the objects have no class. Objects that have it already are left out of the answer. Error: a
  /// hidden object, or a class that is unknown or hidden.
  [[nodiscard]] Result<std::vector<Reclassified>> classify(std::span<const ObjectId> ids, ClassId class_id);
  /// Answers what the class of the objects asks; an empty value takes the answer back. Error: no such
  /// attribute, or not an answer to it (checkedAnswer).
  [[nodiscard]] Result<std::vector<Reclassified>> answer(std::span<const ObjectId> ids,
                                                         const std::string& attribute,
                                                         const std::string& value);
  /// Undoes both, except where others changed the class or the answers since. False: there were such.
  [[nodiscard]] Result<bool> revertReclassified(std::span<const Reclassified> changes);

  // Operations on classes. Errors name the class.

  /// Adds a class. A hidden one of that name returns instead, with its id, unless the draft has an id. Error:
  /// another class has the name or the id; not valid (checkedDraft).
  [[nodiscard]] Result<ClassId> addClass(const ClassDraft& draft) { return classEdits().add(draft); }
  /// Changes what the draft gives of the class with its id. Returns the class before: editing it back undoes
  /// this. Error: as addClass; no such class, or a hidden one.
  [[nodiscard]] Result<ObjectClass> editClass(const ClassDraft& draft) { return classEdits().edit(draft); }
  /// Objects of the classes `from` have the class `into` from now on. Error: hidden or unknown ones.
  [[nodiscard]] Result<ClassMerge> mergeClasses(std::span<const ClassId> from, ClassId into) {
    return classEdits().merge(from, into);
  }
  /// The classes return, and their objects to them. A name that is taken by now becomes "name (2)".
  [[nodiscard]] Result<void> unmergeClasses(const ClassMerge& merge) { return classEdits().unmerge(merge); }
  /// Error: objects have the class.
  [[nodiscard]] Result<void> hideClasses(std::span<const ClassId> ids);
  /// Names as in unmergeClasses.
  [[nodiscard]] Result<void> restoreClasses(std::span<const ClassId> ids) {
    return classEdits().restore(ids);
  }

  /// Changes by operations since the last call, in order.
  [[nodiscard]] std::vector<CatalogueChange> takeChanges() { return std::exchange(changes_, {}); }

 private:
  void apply(CatalogueChange::Kind kind, const ObjectState& after);
  void applyConfirmed(ObjectId id, bool confirmed);
  void applyName(ObjectId id, const std::string& name, NamedBy by);
  void applyHidden(ObjectId id);
  /// Returns the effect; none: nothing changed.
  std::optional<Reclassified> applyClassification(ObjectId id, Classification after);
  [[nodiscard]] ClassEdits classEdits() { return {classes_, place_, changes_}; }
  /// Shows a hidden object again.
  void applyShown(CatalogueChange::Kind kind, ObjectId id);
  [[nodiscard]] std::string called(const ObjectState& object) const;

  std::string place_;
  std::map<ObjectId, ObjectState> objects_;
  std::set<std::pair<ObjectId, ObjectId>> kept_apart_;  // smaller id first
  ClassTable classes_;
  std::vector<CatalogueChange> changes_;
};

}  // namespace scantrove
