#include "core/catalogue/catalogue_mirror.h"

#include <algorithm>
#include <array>
#include <variant>

namespace scantrove {
namespace {
/// Room for what a long scan adds, so that nothing is copied in the middle of it.
constexpr int kViewsOfAScan = 2048;

float middleOf(std::vector<float>& values) {
  const std::size_t half = values.size() / 2;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(half));
  if (values.size() % 2 == 1) return values[half];
  const float below = *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half));
  return (below + values[half]) / 2;
}

/// As ObjectDatabase::merge chooses who holds the views of both.
bool holdsBoth(const ObjectRecord& first, const ObjectRecord& second) {
  const auto said = [](const ObjectRecord& record) {
    return std::pair(record.named_by == NamedBy::person, record.confirmed);
  };
  return said(first) != said(second) ? said(first) > said(second) : first.id < second.id;
}

}  // namespace

void CatalogueMirror::continueSession(Continued from) {
  session_ = from.session;
  next_key_ = from.next_key;
  for (const auto& [key, id] : from.ids) {
    ids_[key] = id;
    keys_[id] = key;
  }
  kept_apart_ = std::move(from.kept_apart);
  regrouped_ = std::move(from.regrouped);
}

CatalogueMirror::Continued CatalogueMirror::continued() const {
  return {session_, next_key_, {ids_.begin(), ids_.end()}, kept_apart_, regrouped_};
}

Result<CataloguePosition> CatalogueMirror::load(ObjectDatabase& database) {
  CataloguePosition position;
  // What happens while this reads is told again by the changes after this one.
  SCANTROVE_TRY(moveInto(position.event, database.lastEvent()));
  Result<std::vector<ObjectRecord>> objects = database.objects();
  if (!objects) return fail(objects.error());
  records_.reserve(objects->size());
  for (ObjectRecord& record : *objects) {
    record.id = keyOf(record.id);
    records_.emplace(record.id, std::move(record));
  }
  const Result<std::vector<MergeRoot>> merge_roots = database.mergeRoots();
  if (!merge_roots) return fail(merge_roots.error());
  for (const MergeRoot& entry : *merge_roots) setMergeRoot(keyOf(entry.object), keyOf(entry.root));
  const Result<int> views = database.viewCount();
  if (!views) return fail(views.error());
  detector_.reserve(*views + kViewsOfAScan);
  SCANTROVE_TRY(moveInto(position.view, database.forEachDescriptor(0, [this](const StoredDescriptor& view) {
    addDescriptor(view);
  })));
  return position;
}

std::vector<ObjectId> CatalogueMirror::ofBefore() const {
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

void CatalogueMirror::setMergeRoot(ObjectId object, ObjectId root) {
  objects_.insert(object);
  detector_.setMergeRoot({object, root});
}

void CatalogueMirror::regroup(ObjectId from, ObjectId into) {
  for (const ObjectId object : objects_) {
    if (mergeRootOf(object) == from) detector_.setMergeRoot({object, into});
  }
}

void CatalogueMirror::addDescriptor(const StoredDescriptor& view) {
  StoredDescriptor own = view;
  own.first_object = keyOf(view.first_object);
  detector_.add(own);
  addSize(own.first_object, own.size_m);
  // In the world of this scan nothing is recognised by its place.
  if (view.place && view.place->session != session_)
    places_.add(view.place->session, own.first_object, view.place->centroid_world);
}

void CatalogueMirror::addSize(ObjectId object, const Eigen::Vector3f& size_m) {
  if (size_m.allFinite() && !size_m.isZero()) sizes_[object].push_back(size_m);
}

Eigen::Vector3f CatalogueMirror::sizeOf(ObjectId root) const {
  std::array<std::vector<float>, 3> sides;
  for (const auto& [object, sizes] : sizes_) {
    if (mergeRootOf(object) != root) continue;
    for (const Eigen::Vector3f& size_m : sizes) {
      for (int i = 0; i < 3; ++i) sides[static_cast<std::size_t>(i)].push_back(size_m[i]);
    }
  }
  if (sides[0].empty()) return Eigen::Vector3f::Zero();
  return {middleOf(sides[0]), middleOf(sides[1]), middleOf(sides[2])};
}

int CatalogueMirror::viewsToCome(ObjectId root) const {
  int views = 0;
  for (const auto& [object, count] : views_to_come_) {
    if (mergeRootOf(object) == root) views += count;
  }
  return views;
}

void CatalogueMirror::add(const ObjectView& first_view) {
  const ObjectId key = first_view.object;
  setMergeRoot(key, key);
  ObjectRecord record;
  record.id = key;
  record.size_m = first_view.size_m;
  records_.emplace(key, std::move(record));
  addView(first_view);
}

void CatalogueMirror::addView(const ObjectView& view) {
  if (view.descriptor) detector_.add({0, view.object, view.size_m, *view.descriptor});
  addSize(view.object, view.size_m);
  ++views_to_come_[view.object];
  const auto found = records_.find(mergeRootOf(view.object));
  if (found == records_.end()) return;
  ++found->second.views;
  if (const Eigen::Vector3f size_m = sizeOf(found->first); !size_m.isZero()) found->second.size_m = size_m;
}

void CatalogueMirror::merge(ObjectId a, ObjectId b) {
  merges_to_come_.emplace_back(a, b);
  const bool first_holds = holdsBoth(records_.at(a), records_.at(b));
  join(first_holds ? a : b, first_holds ? b : a);
}

void CatalogueMirror::join(ObjectId into, ObjectId from) {
  const ObjectRecord other = records_.at(from);
  regroup(from, into);
  records_.erase(from);
  ObjectRecord& record = records_.at(into);
  record.views += other.views;
  record.confirmed = record.confirmed || other.confirmed;
  if (const Eigen::Vector3f size_m = sizeOf(into); !size_m.isZero()) record.size_m = size_m;
}

const ObjectRecord* CatalogueMirror::named(const std::string& name) const {
  for (const auto& [key, record] : records_) {
    if (record.name == name) return &record;
  }
  return nullptr;
}

void CatalogueMirror::name(ObjectId object, const std::string& name) {
  names_to_come_.emplace_back(object, name);
  applyName(object, name);
}

void CatalogueMirror::withdraw(ObjectId object) {
  const bool holds_others = std::ranges::any_of(
      objects_, [&](ObjectId other) { return other != object && mergeRootOf(other) == object; });
  if (holds_others || mergeRootOf(object) != object) return;
  setMergeRoot(object, {});
  records_.erase(object);
  std::erase_if(names_to_come_, [object](const auto& name) { return name.first == object; });
}

void CatalogueMirror::applyName(ObjectId object, const std::string& name) {
  auto own = records_.find(mergeRootOf(object));
  if (own == records_.end()) return;
  const ObjectRecord* other = named(name);
  if (other != nullptr && other->id != own->first) {
    if (isSettled(own->second)) return;
    const ObjectId into = other->id;
    join(into, own->first);
    own = records_.find(into);
  }
  own->second.name = name;
  own->second.named_by = NamedBy::person;
  own->second.confirmed = true;
}

/// One piece of news.
struct CatalogueMirror::Applied {
  CatalogueMirror& mirror;

  void operator()(const news::ObjectStored& e) const {
    mirror.ids_[e.key] = e.record.id;
    mirror.keys_[e.record.id] = e.key;
    const auto found = mirror.records_.find(e.key);
    if (found != mirror.records_.end()) {
      found->second.name = e.record.name;
      found->second.created = e.record.created;
      found->second.first_session = e.record.first_session;
      found->second.first_session_name = e.record.first_session_name;
    }
    mirror.applyToCome();
    settleView(e.key);
  }
  void operator()(const news::ObjectRefused& e) const {
    mirror.setMergeRoot(e.key, {});
    mirror.records_.erase(e.key);
    mirror.views_to_come_.erase(e.key);
  }
  void operator()(const news::ViewStored& e) const { settleView(e.key); }
  void operator()(const news::ViewDropped& e) const {
    settleView(e.key);
    const auto found = mirror.records_.find(mirror.mergeRootOf(e.key));
    if (found != mirror.records_.end()) --found->second.views;
  }
  void operator()(const news::MergeStored& e) const {
    endMerge();
    const ObjectId into = mirror.keyOf(e.merge.into);
    for (const ObjectId from_id : e.merge.from) {
      const ObjectId from = mirror.keyOf(from_id);
      const bool is_into_here = mirror.record(into) != nullptr, is_from_here = mirror.record(from) != nullptr;
      if (is_into_here && is_from_here) {  // an edit came in between
        mirror.join(into, from);
      } else if (is_from_here && e.root) {  // the database chose the other one
        mirror.regroup(from, into);
        mirror.records_.erase(from);
        ObjectRecord record = *e.root;
        record.id = into;
        record.views += mirror.viewsToCome(into);
        mirror.records_[into] = std::move(record);
      }
    }
  }
  void operator()(const news::MergeDropped&) const { endMerge(); }
  void operator()(const news::NameStored&) const { endName(); }
  void operator()(const news::NameDropped&) const { endName(); }
  void operator()(const news::NameTakenBack&) const {}
  void operator()(const news::ViewsDiscarded&) const {}
  void operator()(const news::Edited& e) const { mirror.edit(e.edits); }
  void operator()(const news::Failed&) const {}

 private:
  void settleView(ObjectId key) const {
    const auto found = mirror.views_to_come_.find(key);
    if (found != mirror.views_to_come_.end() && --found->second == 0) mirror.views_to_come_.erase(found);
  }
  void endMerge() const {
    if (!mirror.merges_to_come_.empty()) mirror.merges_to_come_.erase(mirror.merges_to_come_.begin());
  }
  void endName() const {
    if (!mirror.names_to_come_.empty()) mirror.names_to_come_.erase(mirror.names_to_come_.begin());
  }
};

void CatalogueMirror::apply(const CatalogueNews& news) { std::visit(Applied{*this}, news); }

void CatalogueMirror::edit(const CatalogueEdits& edits) {
  for (const ObjectId object : edits.added) setMergeRoot(keyOf(object), keyOf(object));
  for (const MergeRoot& entry : edits.merge_roots) setMergeRoot(keyOf(entry.object), keyOf(entry.root));
  for (const ObjectId object : edits.hidden) records_.erase(keyOf(object));
  for (const StoredDescriptor& view : edits.views) addDescriptor(view);
  for (const ObjectRecord& read : edits.records) {
    ObjectRecord record = read;
    record.id = keyOf(read.id);
    if (mergeRootOf(record.id) != record.id) continue;  // merged here, and not yet there
    record.views += viewsToCome(record.id);
    records_[record.id] = std::move(record);
  }
  for (const auto& [a, b] : edits.unmerged) kept_apart_.insert(std::minmax(keyOf(a), keyOf(b)));
  for (const ObjectId object : edits.regrouped) regrouped_.insert(keyOf(object));
  applyToCome();
}

void CatalogueMirror::applyToCome() {
  for (const auto& [a, b] : merges_to_come_) {
    const ObjectRecord *first = record(mergeRootOf(a)), *second = record(mergeRootOf(b));
    if (first == nullptr || second == nullptr || first == second) continue;
    const bool first_holds = holdsBoth(*first, *second);
    join(first_holds ? first->id : second->id, first_holds ? second->id : first->id);
  }
  for (const auto& [object, name] : names_to_come_) applyName(object, name);
}

}  // namespace scantrove
