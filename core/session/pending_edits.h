#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/editing/region_editor.h"

namespace scantrove {

/// One edit of the catalogue for a region.
struct CatalogueStep {
  enum class Kind {
    name,          ///< names its object, or makes it one
    redo_name,     ///< the same, after an undo reverted it
    revert_name,   ///< reverts the newest naming: the one with `name`, or any if that is empty
    add,           ///< makes it an object
    revert_object  ///< reverts that
  };
  Kind kind = Kind::name;
  RegionId region;
  std::string name = {};
  std::string class_name = {};  ///< of name and redo_name; empty: none is given

  bool operator==(const CatalogueStep&) const = default;
};

/// The pending catalogue edits of an operation in a session. They are written with the operation, and
/// deleted when catalogue and session have them. An interruption therefore leaves no half edit, and a
/// repetition creates no second object.
struct PendingEdit {
  std::string token;  ///< random; tells the catalogue whether it has done the edit
  std::vector<CatalogueStep> steps;

  bool operator==(const PendingEdit&) const = default;
};

/// The session's metadata key for them, oldest first.
inline constexpr const char* kPendingEditsKey = "pending edits";

/// For an operation that was done, undone or redone; none: it does not concern the catalogue. `note_of`:
/// the region's current note.
[[nodiscard]] std::vector<CatalogueStep> catalogueStepsOf(
    const Operation& operation, EditDirection direction,
    const std::function<const RegionNote&(RegionId)>& note_of);

/// Random, unique among all sessions' edits.
[[nodiscard]] std::string newToken();

/// With a new token.
[[nodiscard]] PendingEdit pendingEditOf(std::vector<CatalogueStep> steps);

/// As text; empty for none.
[[nodiscard]] std::string pendingEditsToJson(const std::vector<PendingEdit>& edits);
/// Empty for malformed text.
[[nodiscard]] std::vector<PendingEdit> pendingEditsFromJson(const std::string& text);

}  // namespace scantrove
