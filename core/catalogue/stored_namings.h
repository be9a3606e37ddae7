#pragma once
#include <string>
#include <vector>

#include "core/catalogue/object_record.h"

namespace scantrove {

/// What naming a region did to the catalogue, as its session keeps it, to take it back later.
struct StoredNaming {
  ObjectNaming naming;  ///< no name: it was made an object, and not named
  ObjectId earlier;     ///< the object that the region was before; none: it was none
  ObjectId made = {};   ///< the object that was made for it; none: it was there
  /// It was taken back in the session alone: others had said otherwise of the object by then.
  bool is_overruled = false;
};

/// The session's fact that keeps those of a region.
[[nodiscard]] std::string namingsKeyOf(RegionId region);
/// The one that keeps those of a region that an undo took back, for a redo.
[[nodiscard]] std::string undoneNamingsKeyOf(RegionId region);
/// The one that keeps the object that was made for a region and went with an undo: it comes back with a redo.
[[nodiscard]] std::string removedObjectKeyOf(RegionId region);
/// As text, oldest first; empty for none.
[[nodiscard]] std::string namingsToJson(const std::vector<StoredNaming>& namings);
/// None for what was not written so.
[[nodiscard]] std::vector<StoredNaming> namingsFromJson(const std::string& text);

}  // namespace scantrove
