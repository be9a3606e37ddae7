#pragma once
#include <map>
#include <string>

#include "core/catalogue/region_object.h"
#include "core/editing/region_notes.h"

namespace scantrove {

/// What there is to say of a region. Lists, label maps, pictures and data sets all say this.
struct RegionLabel {
  std::string name, category;  ///< empty: none
  ObjectId object;             ///< of the catalogue
  bool is_named = false;       ///< by a person
  bool is_object = false;
  bool confirmed = false;
  bool background = false;
  bool rejected = false;
};

/// A name that the catalogue has of a person counts for more than the session's, unless the catalogue was
/// never told of that (`is_session_only`). What was deleted is no object.
[[nodiscard]] RegionLabel labelOf(const RegionNote& note, const RegionObject& object,
                                  bool is_session_only = false);

/// Regions that were merged into the object of others are of the class of those.
void shareClasses(std::map<RegionId, RegionLabel>& labels, const std::map<RegionId, RegionObject>& objects);

/// What a session keeps of its regions' objects, for when their catalogue is not there.
struct RememberedObject {
  RegionObject object;
  std::string catalogue;  ///< identity
  bool operator==(const RememberedObject&) const = default;
};
using RememberedObjects = std::map<RegionId, RememberedObject>;

/// The fact that keeps the name that a region got in its session alone.
[[nodiscard]] inline std::string sessionOnlyKeyOf(RegionId region) {
  return "session only " + std::to_string(region.value);
}
/// The fact that keeps them.
inline constexpr const char* kObjectsKey = "objects";
[[nodiscard]] std::string rememberedToText(const RememberedObjects& objects);
/// None for what was not written so.
[[nodiscard]] RememberedObjects rememberedFrom(const std::string& text);
/// `now`: of all regions that are objects of `catalogue`. Of the others what another catalogue said stays.
[[nodiscard]] RememberedObjects remember(RememberedObjects before,
                                         const std::map<RegionId, RegionObject>& now,
                                         const std::string& catalogue);

}  // namespace scantrove
