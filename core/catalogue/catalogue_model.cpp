#include "core/catalogue/catalogue_model.h"

#include <algorithm>
#include <array>
#include <functional>

#include "core/base/label_name.h"

namespace scantrove {

namespace {
using Kind = CatalogueChange::Kind;
}  // namespace

const ObjectState* CatalogueModel::find(ObjectId id) const {
  const auto found = objects_.find(id);
  return found == objects_.end() ? nullptr : &found->second;
}

const ObjectState* CatalogueModel::visible(ObjectId id) const {
  const ObjectState* object = find(id);
  return object != nullptr && !object->hidden ? object : nullptr;
}

const ObjectState* CatalogueModel::named(const std::string& name) const {
  const auto found = std::ranges::find_if(
      objects_, [&](const auto& entry) { return !entry.second.hidden && entry.second.name == name; });
  return found == objects_.end() ? nullptr : &found->second;
}

std::string CatalogueModel::called(const ObjectState& object) const {
  return "The object " + std::to_string(object.id.value) + " (" + object.name + ") in " + place_;
}

Result<ObjectState> CatalogueModel::known(ObjectId id) const {
  const ObjectState* object = find(id);
  if (object != nullptr) return *object;
  return fail("The database " + place_ + " holds no object " + std::to_string(id.value) + ".",
              "List its objects for the numbers there are.");
}

Result<ObjectState> CatalogueModel::shown(ObjectId id) const {
  Result<ObjectState> object = known(id);
  if (!object || !object->hidden) return object;
  if (object->merged_into) {
    return fail(
        called(*object) + " was merged into object " + std::to_string(object->merged_into.value) + ".",
        "Use that one, or undo the merge.");
  }
  return fail(called(*object) + " was deleted.", "Restore it first.");
}

ObjectId CatalogueModel::viewOwner(ObjectId id) const {
  const ObjectState* object = find(id);
  if (object == nullptr) return {};
  std::set<ObjectId> passed;
  while (object->hidden && object->merged_into && passed.insert(object->id).second) {
    const ObjectState* next = find(object->merged_into);
    if (next == nullptr) break;
    object = next;
  }
  return object->id;
}

ObjectId CatalogueModel::mergeRoot(ObjectId id) const {
  const ObjectId owner = viewOwner(id);
  return visible(owner) != nullptr ? owner : ObjectId{};
}

bool CatalogueModel::mayMerge(ObjectId a, ObjectId b) const {
  const ObjectState *first = visible(a), *second = visible(b);
  if (first == nullptr || second == nullptr || a == b || areKeptApart(a, b)) return false;
  return !(isSettled(*first) && isSettled(*second));
}

void CatalogueModel::apply(Kind kind, const ObjectState& after) {
  ObjectState& object = objects_.at(after.id);
  changes_.push_back({kind, std::exchange(object, after), after, 0, {}});
}

void CatalogueModel::applyConfirmed(ObjectId id, bool confirmed) {
  ObjectState object = objects_.at(id);
  if (object.confirmed == confirmed) return;
  object.confirmed = confirmed;
  apply(confirmed ? Kind::confirmed : Kind::unconfirmed, std::move(object));
}

void CatalogueModel::applyName(ObjectId id, const std::string& name, NamedBy by) {
  ObjectState object = objects_.at(id);
  if (object.name == name && object.named_by == by) return;
  object.name = name;
  object.named_by = by;
  apply(Kind::renamed, std::move(object));
}

void CatalogueModel::applyHidden(ObjectId id) {
  ObjectState object = objects_.at(id);
  object.hidden = true;
  apply(Kind::removed, std::move(object));
}

std::optional<Reclassified> CatalogueModel::applyClassification(ObjectId id, Classification after) {
  ObjectState object = objects_.at(id);
  if (object.classification == after) return std::nullopt;
  Reclassified change{id, std::exchange(object.classification, after), std::move(after)};
  apply(Kind::classified, std::move(object));
  return change;
}

void CatalogueModel::applyShown(Kind kind, ObjectId id) {
  const ObjectState& hidden = objects_.at(id);
  ObjectState object = hidden;
  for (int copy = 2; named(object.name) != nullptr; ++copy)
    object.name = hidden.name + " (" + std::to_string(copy) + ")";
  object.hidden = false;
  object.merged_into = {};
  apply(kind, std::move(object));
}

Result<void> CatalogueModel::rename(ObjectId id, const std::string& name, NamedBy by) {
  const Result<std::string> checked = checkedLabelName(name);
  if (!checked) return fail(checked.error());
  const Result<ObjectState> object = shown(id);
  if (!object) return fail(object.error());
  if (const ObjectState* other = named(*checked); other != nullptr && other->id != id) {
    return fail("Another object in " + place_ + " is called " + *checked + ".",
                "Choose another name, or merge the two if they are one.");
  }
  applyName(id, *checked, by);
  return {};
}

Result<void> CatalogueModel::setConfirmed(std::span<const ObjectId> ids, bool confirmed) {
  for (const ObjectId id : ids) {
    if (const Result<ObjectState> object = shown(id); !object) return fail(object.error());
  }
  for (const ObjectId id : ids) applyConfirmed(id, confirmed);
  return {};
}

Result<ObjectNaming> CatalogueModel::nameByUser(ObjectId id, const std::string& name,
                                                const std::string& class_name) {
  const Result<std::string> checked = checkedLabelName(name);
  if (!checked) return fail(checked.error());
  const Result<ClassDraft> draft = checkedDraft({.name = class_name});
  if (!draft) return fail(draft.error());
  if (const Result<ObjectState> object = known(id); !object) return fail(object.error());
  const Result<ObjectState> own = shown(viewOwner(id));
  if (!own) return fail(own.error());
  const ObjectState* other = named(*checked);
  const bool is_other = other != nullptr && other->id != own->id;
  if (is_other && isSettled(*own)) return ObjectNaming{};
  const ObjectState before = is_other ? *other : *own;
  ObjectNaming naming{before.id, *checked, before.name, before.named_by, before.confirmed};
  applyName(before.id, *checked, NamedBy::user);  // first, because a user's name decides the root
  applyConfirmed(before.id, true);
  const ObjectClass* known = nullptr;
  if (!draft->name.empty()) {
    if (classes_.named(draft->name) == nullptr) SCANTROVE_TRY(moveInto(naming.made_class, addClass(*draft)));
    known = classes_.named(draft->name);
  } else if (classOf(before.classification) == nullptr) {
    known = classes_.suggestedBy(*checked);
  }
  if (known != nullptr && known != classOf(before.classification))
    naming.reclassified = applyClassification(before.id, {known->id, before.classification.attributes});
  if (is_other) SCANTROVE_TRY(moveInto(naming.merge, merge(std::array{before.id, own->id})));
  return naming;
}

Result<bool> CatalogueModel::revertNaming(const ObjectNaming& naming) {
  const Result<ObjectState> object = known(naming.object);
  if (!object) return fail(object.error());
  bool is_done = false;
  if (naming.merge) {
    const Result<ObjectState> part = known(naming.merge->from.front());
    if (!part) return fail(part.error());
    is_done = part->hidden && part->merged_into == naming.object;
    if (is_done) SCANTROVE_TRY(unmerge(*naming.merge));
  }
  const ObjectState& now = objects_.at(naming.object);
  if (now.hidden || now.name != naming.name || now.named_by != NamedBy::user) return is_done;
  if (const ObjectState* other = named(naming.earlier_name); other != nullptr && other->id != now.id)
    return is_done;
  applyName(naming.object, naming.earlier_name, naming.earlier_named_by);
  if (!naming.earlier_confirmed) applyConfirmed(naming.object, false);
  if (naming.reclassified) SCANTROVE_TRY(revertReclassified({&*naming.reclassified, 1}));
  const ObjectClass* made = classes_.find(naming.made_class);
  if (made != nullptr && !made->hidden && !isUsed(made->id))
    return hideClasses({&made->id, 1}).map([] { return true; });
  return true;
}

Result<ObjectMerge> CatalogueModel::merge(std::span<const ObjectId> ids) {
  const std::set<ObjectId> distinct(ids.begin(), ids.end());
  if (distinct.size() < 2)
    return fail("An object cannot be merged with itself.", "Choose two objects or more.");
  std::vector<ObjectState> ranked;  // oldest first
  for (const ObjectId id : distinct) {
    const Result<ObjectState> object = shown(id);
    if (!object) return fail(object.error());
    ranked.push_back(*object);
  }
  std::ranges::stable_sort(ranked, std::greater<>(), [](const ObjectState& object) {
    return std::pair(object.named_by == NamedBy::user, object.confirmed);
  });
  const ObjectState& root = ranked.front();
  ObjectMerge merge{root.id, {}, false};
  for (ObjectState object : std::span(ranked).subspan(1)) {
    object.hidden = true;
    object.merged_into = root.id;
    merge.from.push_back(object.id);
    merge.has_confirmed = merge.has_confirmed || (object.confirmed && !root.confirmed);
    apply(Kind::merged, std::move(object));
  }
  if (merge.has_confirmed) applyConfirmed(root.id, true);
  if (classOf(root.classification) != nullptr) return merge;
  const auto classified = std::ranges::find_if(
      ranked, [this](const ObjectState& object) { return classOf(object.classification) != nullptr; });
  if (classified == ranked.end()) return merge;
  Classification taken{classified->classification.class_id, root.classification.attributes};
  taken.attributes.insert(classified->classification.attributes.begin(),
                          classified->classification.attributes.end());
  merge.reclassified = applyClassification(root.id, std::move(taken));
  return merge;
}

Result<void> CatalogueModel::unmerge(const ObjectMerge& merge) {
  if (const Result<ObjectState> into = known(merge.into); !into) return fail(into.error());
  for (const ObjectId id : merge.from) {
    const Result<ObjectState> object = known(id);
    if (!object) return fail(object.error());
    if (!object->hidden || object->merged_into != merge.into) {
      return fail(called(*object) + " is not merged into object " + std::to_string(merge.into.value) + ".",
                  "There is nothing to undo.");
    }
  }
  for (const ObjectId id : merge.from) applyShown(Kind::unmerged, id);
  if (merge.has_confirmed) applyConfirmed(merge.into, false);
  if (merge.reclassified) SCANTROVE_TRY(revertReclassified({&*merge.reclassified, 1}));
  // It may be merged into another object by now, which had these views, too.
  const ObjectId owner = viewOwner(merge.into);
  if (owner != merge.into) {
    const ObjectState& object = objects_.at(owner);
    changes_.push_back({Kind::views_discarded, object, object, 0, merge.from.front()});
  }
  return {};
}

Result<void> CatalogueModel::remove(std::span<const ObjectId> ids) {
  const std::set<ObjectId> distinct(ids.begin(), ids.end());
  for (const ObjectId id : distinct) {
    if (const Result<ObjectState> object = shown(id); !object) return fail(object.error());
  }
  for (const ObjectId id : distinct) applyHidden(id);
  return {};
}

Result<void> CatalogueModel::restore(std::span<const ObjectId> ids) {
  for (const ObjectId id : ids) {
    const Result<ObjectState> object = known(id);
    if (!object) return fail(object.error());
    if (object->hidden && object->merged_into) return fail(shown(id).error());
  }
  for (const ObjectId id : ids) {
    if (objects_.at(id).hidden) applyShown(Kind::restored, id);
  }
  return {};
}

Result<bool> CatalogueModel::withdraw(ObjectId made) {
  const Result<ObjectState> object = known(made);
  if (!object) return fail(object.error());
  const bool has_parts =
      std::ranges::any_of(objects_, [made](const auto& entry) { return entry.second.merged_into == made; });
  if (object->hidden || isSettled(*object) || has_parts) return false;
  applyHidden(made);
  return true;
}

// Classes.

AttributeValues CatalogueModel::answersOf(const Classification& classification) const {
  AttributeValues answers;
  const ObjectClass* root = classOf(classification);
  if (root == nullptr || classification.attributes.empty()) return answers;
  for (const ClassAttribute& attribute : classes_.attributesOf(root->id)) {
    const auto found = classification.attributes.find(attribute.name);
    if (found != classification.attributes.end()) answers.insert(*found);
  }
  return answers;
}

bool CatalogueModel::isUsed(ClassId root) const {
  return std::ranges::any_of(objects_, [&](const auto& entry) {
    const ObjectClass* own = entry.second.hidden ? nullptr : classOf(entry.second.classification);
    return own != nullptr && own->id == root;
  });
}

Result<void> CatalogueModel::hideClasses(std::span<const ClassId> ids) {
  const auto used = std::ranges::find_if(ids, [this](ClassId id) { return isUsed(id); });
  if (used != ids.end()) {
    return fail("Objects in " + place_ + " have the class " + classes_.find(*used)->name + ".",
                "Classify them first, or merge the class into another one.");
  }
  return classEdits().hide(ids);
}

Result<std::vector<Reclassified>> CatalogueModel::classify(std::span<const ObjectId> ids, ClassId class_id) {
  if (class_id) {
    if (const Result<ObjectClass> known = classEdits().shown(class_id); !known) return fail(known.error());
  }
  for (const ObjectId id : ids) {
    if (const Result<ObjectState> object = shown(id); !object) return fail(object.error());
  }
  std::vector<Reclassified> changes;
  for (const ObjectId id : ids) {
    const Classification& own = objects_.at(id).classification;
    const ObjectClass* root = classOf(own);
    if (root != nullptr ? root->id == class_id : !class_id) continue;
    if (auto change = applyClassification(id, {class_id, own.attributes}))
      changes.push_back(std::move(*change));
  }
  return changes;
}

Result<std::vector<Reclassified>> CatalogueModel::answer(std::span<const ObjectId> ids,
                                                         const std::string& attribute,
                                                         const std::string& value) {
  std::map<ObjectId, std::string> values;
  for (const ObjectId id : ids) {
    const Result<ObjectState> object = shown(id);
    if (!object) return fail(object.error());
    const ObjectClass* root = classOf(object->classification);
    if (root == nullptr) return fail(called(*object) + " has no class.", "Classify it first.");
    const std::vector<ClassAttribute> asked = classes_.attributesOf(root->id);
    const auto found = std::ranges::find(asked, attribute, &ClassAttribute::name);
    if (found == asked.end()) {
      return fail("The class " + root->name + " has no attribute '" + attribute + "'.",
                  "Give it to the class first.");
    }
    SCANTROVE_TRY(moveInto(values[id], checkedAnswer(*found, value)));
  }
  std::vector<Reclassified> changes;
  for (const auto& [id, text] : values) {
    Classification after = objects_.at(id).classification;
    after.attributes.erase(attribute);
    if (!text.empty()) after.attributes[attribute] = text;
    if (auto change = applyClassification(id, std::move(after))) changes.push_back(std::move(*change));
  }
  return changes;
}

Result<bool> CatalogueModel::revertReclassified(std::span<const Reclassified> changes) {
  for (const Reclassified& change : changes) {
    if (const Result<ObjectState> object = known(change.object); !object) return fail(object.error());
  }
  bool are_all = true;
  for (const Reclassified& change : changes) {
    const bool is_unchanged = objects_.at(change.object).classification == change.after;
    if (is_unchanged) applyClassification(change.object, change.before);
    are_all = are_all && is_unchanged;
  }
  return are_all;
}

}  // namespace scantrove
