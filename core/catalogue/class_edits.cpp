#include "core/catalogue/class_edits.h"

#include <algorithm>
#include <set>
#include <utility>

namespace scantrove {
namespace {

using Kind = CatalogueChange::Kind;

std::string calledClass(const ObjectClass& object_class) {
  return "The class " + std::to_string(object_class.id.value) + " (" + object_class.name + ")";
}
}  // namespace

Result<ObjectClass> ClassEdits::shown(ClassId id) const {
  const ObjectClass* known = classes_.find(id);
  if (known == nullptr) {
    return fail("The database " + place_ + " holds no class " + std::to_string(id.value) + ".",
                "List its classes for the numbers there are.");
  }
  if (!known->hidden) return *known;
  const std::string called = calledClass(*known) + " in " + place_;
  if (!known->merged_into) return fail(called + " is hidden.", "Restore it first.");
  return fail(called + " was merged into class " + std::to_string(known->merged_into.value) + ".",
              "Use that one, or undo the merge.");
}

void ClassEdits::apply(Kind kind, const ObjectClass& after) {
  const ObjectClass* known = classes_.find(after.id);
  CatalogueChange change;
  change.kind = kind;
  change.of_class = ClassChange{known != nullptr ? *known : ObjectClass{}, after};
  changes_.push_back(std::move(change));
  classes_.put(after);
}

void ClassEdits::applyShown(Kind kind, ClassId id) {
  const ObjectClass hidden = *classes_.find(id);
  ObjectClass after = hidden;
  for (int copy = 2; classes_.named(after.name) != nullptr; ++copy)
    after.name = hidden.name + " (" + std::to_string(copy) + ")";
  after.hidden = false;
  after.merged_into = {};
  apply(kind, after);
}

Result<ClassId> ClassEdits::add(const ClassDraft& draft) {
  const Result<ClassDraft> checked = checkedDraft(draft);
  if (!checked) return fail(checked.error());
  if (checked->name.empty()) return fail("A class needs a name.", "Type one.");
  if (const ObjectClass* other = classes_.named(checked->name))
    return fail(calledClass(*other) + " in " + place_ + " has that name.", "Choose another name.");
  if (const ObjectClass* other = classes_.find(checked->id)) {
    return fail(
        calledClass(*other) + " in " + place_ + " has or had the id " + std::to_string(other->id.value) + ".",
        "Choose another id, or none.");
  }
  const ObjectClass* earlier = checked->id ? nullptr : classes_.hiddenNamed(checked->name);
  if (earlier != nullptr) {
    ClassDraft changes = *checked;
    changes.id = earlier->id;
    applyShown(Kind::class_restored, earlier->id);
    return edit(changes).map([id = changes.id](const ObjectClass&) { return id; });
  }
  ObjectClass made;
  made.id = checked->id ? checked->id : classes_.nextId();
  made.name = checked->name;
  made.color = checked->color.value_or(defaultClassColor(made.id));
  made.supercategory = checked->supercategory.value_or("");
  made.attributes = checked->attributes.value_or(std::vector<ClassAttribute>());
  apply(Kind::class_added, made);
  return made.id;
}

Result<ObjectClass> ClassEdits::edit(const ClassDraft& draft) {
  const Result<ClassDraft> checked = checkedDraft(draft);
  if (!checked) return fail(checked.error());
  Result<ObjectClass> before = shown(checked->id);
  if (!before) return before;
  const ObjectClass* other = checked->name.empty() ? nullptr : classes_.named(checked->name);
  if (other != nullptr && other->id != before->id) {
    return fail(calledClass(*other) + " in " + place_ + " has that name.",
                "Choose another name, or merge the two if they are one.");
  }
  ObjectClass after = *before;
  if (!checked->name.empty()) after.name = checked->name;
  after.color = checked->color.value_or(after.color);
  after.supercategory = checked->supercategory.value_or(after.supercategory);
  after.attributes = checked->attributes.value_or(after.attributes);
  if (after != *before) apply(Kind::class_edited, after);
  return before;
}

Result<ClassMerge> ClassEdits::merge(std::span<const ClassId> from, ClassId into) {
  const std::set<ClassId> distinct(from.begin(), from.end());
  if (const Result<ObjectClass> root = shown(into); !root) return fail(root.error());
  for (const ClassId id : distinct) {
    if (const Result<ObjectClass> part = shown(id); !part) return fail(part.error());
  }
  if (distinct.empty() || distinct.contains(into))
    return fail("A class cannot be merged with itself.", "Choose two classes or more.");
  for (const ClassId id : distinct) {
    ObjectClass part = *classes_.find(id);
    part.hidden = true;
    part.merged_into = into;
    apply(Kind::class_merged, part);
  }
  return ClassMerge{into, {distinct.begin(), distinct.end()}};
}

Result<void> ClassEdits::unmerge(const ClassMerge& merge) {
  for (const ClassId id : merge.from) {
    const ObjectClass* part = classes_.find(id);
    if (part == nullptr) return fail(shown(id).error());
    if (!part->hidden || part->merged_into != merge.into) {
      return fail(calledClass(*part) + " in " + place_ + " is not merged into class " +
                      std::to_string(merge.into.value) + ".",
                  "There is nothing to undo.");
    }
  }
  for (const ClassId id : merge.from) applyShown(Kind::class_unmerged, id);
  return {};
}

Result<void> ClassEdits::hide(std::span<const ClassId> ids) {
  const std::set<ClassId> distinct(ids.begin(), ids.end());
  for (const ClassId id : distinct) {
    if (const Result<ObjectClass> known = shown(id); !known) return fail(known.error());
  }
  for (const ClassId id : distinct) {
    ObjectClass hidden = *classes_.find(id);
    hidden.hidden = true;
    apply(Kind::class_hidden, hidden);
  }
  return {};
}

Result<void> ClassEdits::restore(std::span<const ClassId> ids) {
  for (const ClassId id : ids) {
    const ObjectClass* known = classes_.find(id);
    if (known == nullptr || (known->hidden && known->merged_into)) return fail(shown(id).error());
  }
  for (const ClassId id : ids) {
    if (classes_.find(id)->hidden) applyShown(Kind::class_restored, id);
  }
  return {};
}

}  // namespace scantrove
