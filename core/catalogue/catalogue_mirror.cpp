#include "core/catalogue/catalogue_mirror.h"

#include <algorithm>
#include <array>
#include <variant>

#include "core/catalogue/median_size.h"

namespace scantrove {
namespace {

/// Room for the views of a long scan, to avoid copying in the middle of it.
constexpr int kViewsOfAScan = 2048;

}  // namespace

CatalogueMirror::Continued CatalogueMirror::continued() const {
  return {session_, next_key_, {ids_.begin(), ids_.end()}, model_.keptApart(), merge_edited_};
}

void CatalogueMirror::continueSession(Continued earlier) {
  session_ = earlier.session;
  next_key_ = earlier.next_key;
  for (const auto& [key, id] : earlier.ids) {
    ids_[key] = id;
    keys_[id] = key;
  }
  for (const auto& [a, b] : earlier.kept_apart) model_.keepApart(a, b);
  merge_edited_ = std::move(earlier.merge_edited);
}

Result<CataloguePosition> CatalogueMirror::load(ObjectDatabase& database) {
  CataloguePosition position;
  // Changes during this read occur again among the later changes.
  SCANTROVE_TRY(moveInto(position.event, database.lastEvent()));
  Result<std::vector<ObjectRecord>> objects = database.objects();
  if (!objects) return fail(objects.error());
  records_.reserve(objects->size());
  for (ObjectRecord& record : *objects) {
    record.id = keyOf(record.id);
    records_.emplace(record.id, std::move(record));
  }
  const Result<CatalogueModel> model = database.model();
  if (!model) return fail(model.error());
  for (const auto& [id, object] : model->objects()) put(object);
  model_.putClasses(model->classes());
  updateRoots();
  const Result<int> views = database.views().count();
  if (!views) return fail(views.error());
  detector_.reserve(*views + kViewsOfAScan);
  SCANTROVE_TRY(moveInto(
      position.view,
      database.views().forEachDescriptor(0, [this](const StoredDescriptor& view) { addDescriptor(view); })));
  return position;
}

std::vector<ObjectId> CatalogueMirror::earlierObjects() const {
  std::vector<ObjectId> objects;
  for (const auto& [key, record] : records_) {
    if (!isOfThisScan(key)) objects.push_back(key);
  }
  std::ranges::sort(objects);
  return objects;
}

const ObjectRecord* CatalogueMirror::record(ObjectId object) const {
  const auto found = records_.find(object);
  return found == records_.end() ? nullptr : &found->second;
}

ObjectId CatalogueMirror::idOf(ObjectId key) const {
  if (!isOfThisScan(key)) return key;
  const auto found = ids_.find(key);
  return found == ids_.end() ? ObjectId{} : found->second;
}

ObjectId CatalogueMirror::keyOf(ObjectId id) const {
  const auto found = keys_.find(id);
  return found == keys_.end() ? id : found->second;
}

void CatalogueMirror::put(const ObjectState& of_database) {
  ObjectState object = of_database;
  object.id = keyOf(object.id);
  object.merged_into = keyOf(object.merged_into);
  model_.put(std::move(object));
}

void CatalogueMirror::setHidden(ObjectId object) {
  ObjectState hidden;
  hidden.id = object;
  hidden.hidden = true;
  model_.put(std::move(hidden));
  detector_.setMergeRoot({object, {}});
  records_.erase(object);
}

void CatalogueMirror::updateRoots() {
  for (const auto& [object, state] : model_.objects())
    detector_.setMergeRoot({object, model_.mergeRoot(object)});
}

void CatalogueMirror::updateFromModel() {
  for (const CatalogueChange& change : model_.takeChanges()) {
    const ObjectState& object = change.after;
    if (change.kind == CatalogueChange::Kind::merged) {
      join(object.merged_into, object.id);
    } else if (object.hidden) {
      detector_.setMergeRoot({object.id, {}});
      records_.erase(object.id);
    } else if (const auto found = records_.find(object.id); found != records_.end()) {
      found->second.name = object.name;
      found->second.named_by = object.named_by;
      found->second.confirmed = object.confirmed;
      found->second.classification = object.classification;
    }
  }
}

void CatalogueMirror::addDescriptor(const StoredDescriptor& view) {
  StoredDescriptor own = view;
  own.first_object = keyOf(view.first_object);
  detector_.add(own);
  addSize(own.first_object, own.size_m);
  // Nothing is recognised by place in the scan's own world.
  if (view.place && view.place->session != session_)
    places_.add(view.place->session, own.first_object, view.place->centroid_world);
}

void CatalogueMirror::addSize(ObjectId object, const Eigen::Vector3f& size_m) {
  if (size_m.allFinite() && !size_m.isZero()) sizes_[object].push_back(size_m);
}

Eigen::Vector3f CatalogueMirror::sizeOf(ObjectId root) const {
  MedianSize size;
  for (const auto& [object, sizes] : sizes_) {
    if (mergeRootOf(object) != root) continue;
    for (const Eigen::Vector3f& size_m : sizes) size.add(size_m);
  }
  return size.value_m();
}

int CatalogueMirror::pendingViews(ObjectId root) const {
  int views = 0;
  for (const auto& [object, count] : pending_views_) {
    if (mergeRootOf(object) == root) views += count;
  }
  return views;
}

void CatalogueMirror::add(const ObjectView& first_view) {
  const ObjectId key = first_view.object;
  ObjectState object;
  object.id = key;
  model_.put(std::move(object));
  detector_.setMergeRoot({key, key});
  ObjectRecord record;
  record.id = key;
  record.size_m = first_view.size_m;
  records_.emplace(key, std::move(record));
  addView(first_view);
}

void CatalogueMirror::addView(const ObjectView& view) {
  if (view.descriptor) detector_.add({0, view.object, view.size_m, *view.descriptor, {}});
  addSize(view.object, view.size_m);
  ++pending_views_[view.object];
  const auto found = records_.find(mergeRootOf(view.object));
  if (found == records_.end()) return;
  ++found->second.views;
  if (const Eigen::Vector3f size_m = sizeOf(found->first); !size_m.isZero()) found->second.size_m = size_m;
}

void CatalogueMirror::merge(ObjectId a, ObjectId b) {
  pending_merges_.emplace_back(a, b);
  static_cast<void>(model_.merge(std::array{a, b}));
  updateFromModel();
}

void CatalogueMirror::join(ObjectId into, ObjectId from) {
  for (const auto& [object, state] : model_.objects()) {
    if (mergeRootOf(object) == from) detector_.setMergeRoot({object, into});
  }
  const auto other = records_.extract(from);
  const auto found = records_.find(into);
  if (found == records_.end()) return;
  ObjectRecord& record = found->second;
  if (!other.empty()) record.views += other.mapped().views;
  if (const Eigen::Vector3f size_m = sizeOf(into); !size_m.isZero()) record.size_m = size_m;
}

void CatalogueMirror::name(ObjectId object, const GivenName& given) {
  pending_names_.emplace_back(object, given);
  applyName(object, given);
}

void CatalogueMirror::applyName(ObjectId object, const GivenName& given) {
  if (!mergeRootOf(object)) return;
  static_cast<void>(model_.nameByUser(object, given.name, given.class_name));
  updateFromModel();
}

void CatalogueMirror::withdraw(ObjectId object) {
  const ObjectState* named = model_.visible(object);
  if (named == nullptr) return;
  const ObjectState before = *named;
  ObjectState made = before;
  made.named_by = NamedBy::program;
  made.confirmed = false;
  model_.put(std::move(made));
  if (!model_.withdraw(object).value_or(false)) return model_.put(before);
  updateFromModel();
  std::erase_if(pending_names_, [object](const auto& name) { return name.first == object; });
}

/// Applies one event of the writer.
struct CatalogueMirror::Applied {
  CatalogueMirror& mirror;

  void operator()(const event::ObjectStored& e) const {
    mirror.ids_[e.key] = e.record.id;
    mirror.keys_[e.record.id] = e.key;
    const auto found = mirror.records_.find(e.key);
    if (found != mirror.records_.end()) {
      found->second.name = e.record.name;
      found->second.created = e.record.created;
      found->second.first_session = e.record.first_session;
      found->second.first_session_name = e.record.first_session_name;
    }
    if (const ObjectState* known = mirror.model_.find(e.key)) {
      ObjectState object = *known;
      object.name = e.record.name;
      mirror.model_.put(std::move(object));
    }
    mirror.applyPending();
    settleView(e.key);
  }
  void operator()(const event::ObjectRefused& e) const {
    mirror.setHidden(e.key);
    mirror.pending_views_.erase(e.key);
  }
  void operator()(const event::ViewStored& e) const { settleView(e.key); }
  void operator()(const event::ViewDropped& e) const {
    settleView(e.key);
    const auto found = mirror.records_.find(mirror.mergeRootOf(e.key));
    if (found != mirror.records_.end()) --found->second.views;
  }
  void operator()(const event::MergeStored& e) const {
    endMerge();
    const ObjectId into = mirror.keyOf(e.merge.into);
    for (const ObjectId from_id : e.merge.from) {
      const ObjectId from = mirror.keyOf(from_id);
      const bool is_into_here = mirror.record(into) != nullptr, is_from_here = mirror.record(from) != nullptr;
      if (is_into_here && is_from_here) {  // an edit came in between
        hide(from, into);
        mirror.join(into, from);
        mirror.records_.at(into).confirmed = mirror.model_.find(into)->confirmed;
        mirror.records_.at(into).classification = mirror.model_.find(into)->classification;
      } else if (is_from_here && e.root) {  // the database chose the other root
        hide(from, into);
        ObjectRecord record = *e.root;
        record.id = into;
        mirror.putRecord(std::move(record));
        mirror.updateRoots();
        mirror.records_.erase(from);
        mirror.records_.at(into).views += mirror.pendingViews(into);
      }
    }
  }
  void operator()(const event::MergeDropped&) const { endMerge(); }
  void operator()(const event::NameStored&) const { endName(); }
  void operator()(const event::NameDropped&) const { endName(); }
  void operator()(const event::NamingReverted&) const {}
  void operator()(const event::ViewsDiscarded&) const {}
  void operator()(const event::Edited& e) const { mirror.edit(e.edits); }
  void operator()(const event::Failed&) const {}

 private:
  /// The database says that `from` is merged into `into`.
  void hide(ObjectId from, ObjectId into) const {
    ObjectState part = *mirror.model_.find(from);
    part.hidden = true;
    part.merged_into = into;
    if (const ObjectState* known = mirror.model_.visible(into)) {
      ObjectState root = *known;
      root.confirmed = root.confirmed || part.confirmed;
      if (mirror.model_.classOf(root.classification) == nullptr) root.classification = part.classification;
      mirror.model_.put(std::move(root));
    }
    mirror.model_.put(std::move(part));
  }
  void settleView(ObjectId key) const {
    const auto found = mirror.pending_views_.find(key);
    if (found != mirror.pending_views_.end() && --found->second == 0) mirror.pending_views_.erase(found);
  }
  void endMerge() const {
    if (!mirror.pending_merges_.empty()) mirror.pending_merges_.erase(mirror.pending_merges_.begin());
  }
  void endName() const {
    if (!mirror.pending_names_.empty()) mirror.pending_names_.erase(mirror.pending_names_.begin());
  }
};

void CatalogueMirror::apply(const CatalogueEvent& event) { std::visit(Applied{*this}, event); }

void CatalogueMirror::putRecord(ObjectRecord record) {
  model_.put({record.id, record.name, record.named_by, record.confirmed, false, {}, record.classification});
  records_[record.id] = std::move(record);
}

void CatalogueMirror::edit(const CatalogueEdits& edits) {
  for (const CatalogueChange& change : edits.changes) {
    if (change.of_class) continue;  // `edits.classes` has all
    const ObjectId object = keyOf(change.object()), other = keyOf(change.mergeTarget());
    if (change.kind == CatalogueChange::Kind::added) {
      put(change.after);
      detector_.setMergeRoot({object, object});
    }
    if (change.kind == CatalogueChange::Kind::unmerged) model_.keepApart(object, other);
    if (!change.movesViews()) continue;
    merge_edited_.insert(object);
    if (other) merge_edited_.insert(other);
  }
  for (const ObjectState& object : edits.objects) put(object);
  // Also without objects: classes that only this mirror made have other ids in the database.
  if (!edits.objects.empty() || !edits.classes.all().empty()) model_.putClasses(edits.classes);
  if (!edits.objects.empty()) {
    updateRoots();
    std::erase_if(records_, [this](const auto& entry) { return model_.visible(entry.first) == nullptr; });
  }
  for (const StoredDescriptor& view : edits.views) addDescriptor(view);
  for (const ObjectRecord& read : edits.records) {
    ObjectRecord record = read;
    record.id = keyOf(read.id);
    if (mergeRootOf(record.id) != record.id) continue;  // merged here, but not yet in the database
    record.views += pendingViews(record.id);
    putRecord(std::move(record));
  }
  applyPending();
}

void CatalogueMirror::applyPending() {
  for (const auto& [a, b] : pending_merges_) {
    const ObjectId first = mergeRootOf(a), second = mergeRootOf(b);
    if (!first || !second || first == second) continue;
    static_cast<void>(model_.merge(std::array{first, second}));
    updateFromModel();
  }
  for (const auto& [object, given] : pending_names_) applyName(object, given);
}

}  // namespace scantrove
