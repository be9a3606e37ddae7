#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "core/catalogue/catalogue_model.h"

namespace scantrove {

/// The catalogue's data about the object of a region.
struct RegionObject {
  enum class State : std::uint8_t { none, known, deleted };
  State state = State::none;
  ObjectId object = {};  ///< its merge root; none: unknown
  std::string name = {};
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  bool is_merged = false;  ///< `object` differs from the object that the region was identified as
  ClassId class_id = {};   ///< its merge root; none: not classified
  std::string class_name = {};
  bool operator==(const RegionObject&) const = default;
};

/// `object_class`: null: not classified.
inline void setClass(RegionObject& object, const ObjectClass* object_class) {
  object.class_id = object_class != nullptr ? object_class->id : ClassId{};
  object.class_name = object_class != nullptr ? object_class->name : std::string();
}

/// For the object `id`; empty: the catalogue never had it.
[[nodiscard]] inline RegionObject regionObjectOf(const CatalogueModel& catalogue, ObjectId id) {
  using State = RegionObject::State;
  if (catalogue.find(id) == nullptr) return {};
  const ObjectState* root = catalogue.find(catalogue.mergeRoot(id));
  if (root == nullptr) return {.state = State::deleted};
  RegionObject object{State::known, root->id, root->name, root->named_by, root->confirmed, root->id != id};
  setClass(object, catalogue.classOf(root->classification));
  return object;
}

/// Whether a region of `object` that a user names is another thing: users gave another name to one of the
/// object's other regions (`names_of_others`), or another object has the name already and this one is
/// settled.
[[nodiscard]] inline bool isAnotherObject(const CatalogueModel& catalogue, ObjectId object,
                                          const std::string& name,
                                          std::span<const std::string> names_of_others) {
  const ObjectState* root = catalogue.visible(catalogue.mergeRoot(object));
  const ObjectState* named = catalogue.named(name);
  const bool is_taken = root != nullptr && named != nullptr && named != root;
  return (is_taken && isSettled(*root)) ||
         std::ranges::any_of(names_of_others, [&](const std::string& other) { return other != name; });
}

}  // namespace scantrove
