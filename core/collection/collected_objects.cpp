#include "core/collection/collected_objects.h"

#include <map>
#include <utility>

namespace scantrove {

void CollectedObjects::describe(SeenObject& seen) const {
  const ObjectRecord* known = catalogue_.currentRecord(tracks_.objectOf(seen.regions));
  const bool is_known = known != nullptr;
  seen.object = is_known ? catalogue_.idOf(known->id) : ObjectId{};
  seen.name = is_known ? known->name : std::string();
  seen.confirmed = is_known && known->confirmed;
  seen.recognized = is_known && !CatalogueMirror::isOfThisScan(known->id);
}

ObjectId CollectedObjects::idOf(RegionId region) const {
  return catalogue_.idOf(catalogue_.mergeRootOf(tracks_.objectOf(region)));
}

RegionObject CollectedObjects::describe(RegionId region) const {
  const ObjectId object = tracks_.objectOf(region), root = catalogue_.mergeRootOf(object);
  const ObjectRecord* known = catalogue_.record(root);
  if (known == nullptr) return {.state = object ? RegionObject::State::deleted : RegionObject::State::none};
  const ObjectId id = catalogue_.idOf(known->id);
  if (!id) return {};  // not stored yet
  RegionObject described{
      RegionObject::State::known, id, known->name, known->named_by, known->confirmed, root != object};
  setClass(described, catalogue_.model().classOf(known->classification));
  return described;
}

std::vector<CollectedObject> CollectedObjects::list() const {
  std::map<ObjectId, CollectedObject> objects;
  for (const auto& [object, track] : tracks_.all()) {
    const ObjectRecord* known = catalogue_.currentRecord(object);
    const ObjectId id = known != nullptr ? catalogue_.idOf(known->id) : ObjectId{};
    if (!id) continue;
    objects[id] = {id, known->name, known->confirmed, known->views,
                   CatalogueMirror::isOfThisScan(known->id) ? std::string() : known->first_session_name};
  }
  std::vector<CollectedObject> list;
  for (auto& [id, object] : objects) list.push_back(std::move(object));
  return list;
}

}  // namespace scantrove
