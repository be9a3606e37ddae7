#pragma once
#include <map>
#include <string>

#include "core/catalogue/region_object.h"
#include "core/editing/region_notes.h"
#include "core/labeling/support_pixels.h"

namespace scantrove {

/// The label of a region, as in lists, label maps, pictures and data sets.
struct RegionLabel {
  std::string name, category;  ///< empty: none
  ObjectId object;             ///< in the catalogue
  bool is_named = false;       ///< by a user
  bool is_object = false;
  bool confirmed = false;
  bool background = false;
  bool rejected = false;
  ClassId class_id = {};  ///< of `category` in the catalogue; none: only the session has it
};

/// A user's name and the class in the catalogue take precedence over the session's, unless the catalogue
/// never received these (`is_session_only`). A deleted entry is no object.
[[nodiscard]] RegionLabel labelOf(const RegionNote& note, const RegionObject& object,
                                  bool is_session_only = false);

/// Whether a region looks like background and nobody has decided on it: a support without a note that is no
/// object of the catalogue. `label`: labelOf(note, its object).
[[nodiscard]] inline bool isProposedBackground(const SupportPixels& pixels, const RegionNote& note,
                                               const RegionLabel& label) {
  return pixels.isSupport() && note == RegionNote{} && !label.is_object;
}

/// Regions merged into an object without class in the catalogue get the category of its other regions.
void shareClasses(std::map<RegionId, RegionLabel>& labels, const std::map<RegionId, RegionObject>& objects);

/// A session's copy of its regions' objects, used when the catalogue is missing.
struct RememberedObject {
  RegionObject object;
  std::string catalogue;  ///< identity
  bool operator==(const RememberedObject&) const = default;
};
using RememberedObjects = std::map<RegionId, RememberedObject>;

/// The metadata key for a region's name that only its session has.
[[nodiscard]] inline std::string sessionOnlyKeyOf(RegionId region) {
  return "session only " + std::to_string(region.value);
}
/// The metadata key for the copy.
inline constexpr const char* kObjectsKey = "objects";
[[nodiscard]] std::string rememberedToText(const RememberedObjects& objects);
/// Empty for malformed text.
[[nodiscard]] RememberedObjects rememberedFrom(const std::string& text);
/// `now`: all regions that are objects of `catalogue`. Other regions keep data from another catalogue.
[[nodiscard]] RememberedObjects remember(RememberedObjects before,
                                         const std::map<RegionId, RegionObject>& now,
                                         const std::string& catalogue);

}  // namespace scantrove
