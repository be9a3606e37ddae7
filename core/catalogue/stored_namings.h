#pragma once
#include <string>
#include <vector>

#include "core/catalogue/object_record.h"

namespace scantrove {

/// The effect of naming a region on the catalogue, as its session stores it for undo.
struct StoredNaming {
  ObjectNaming naming;  ///< no name: the region was made an object without a name
  ObjectId earlier;     ///< the region's former object; none: it had none
  ObjectId made = {};   ///< the object made for the region; none: it existed
  /// It was undone in the session only, because others had changed the object since.
  bool is_overruled = false;
};

/// The metadata key for the namings of a region.
[[nodiscard]] std::string namingsKeyOf(RegionId region);
/// The metadata key for undone namings of a region, for a redo.
[[nodiscard]] std::string undoneNamingsKeyOf(RegionId region);
/// The metadata key for the object that was made for a region and removed by an undo, for a redo.
[[nodiscard]] std::string removedObjectKeyOf(RegionId region);
/// As text, oldest first; empty for none.
[[nodiscard]] std::string namingsToJson(const std::vector<StoredNaming>& namings);
/// Empty for text of another form.
[[nodiscard]] std::vector<StoredNaming> namingsFromJson(const std::string& text);

}  // namespace scantrove
