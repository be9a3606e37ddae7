#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/editing/region_editor.h"

namespace scantrove {

/// One thing that the catalogue is to do for a region.
struct CatalogueStep {
  enum class Kind {
    name,          ///< its object gets the name; where it is none, it becomes one
    redo_name,     ///< the same, where an undo has reverted that
    revert_name,   ///< the newest naming is reverted: that with `name` or, where that is empty, any
    add,           ///< it becomes an object
    revert_object  ///< that is reverted
  };
  Kind kind = Kind::name;
  RegionId region;
  std::string name = {};

  bool operator==(const CatalogueStep&) const = default;
};

/// What an operation in a session has still to do in the session's catalogue. It is written with the
/// operation itself, and goes when the catalogue and then the session have it: so an interruption in between
/// leaves neither half an edit nor, when it is tried again, a second object.
struct PendingEdit {
  std::string token;  ///< by which the catalogue knows whether it did it; random
  std::vector<CatalogueStep> steps;

  bool operator==(const PendingEdit&) const = default;
};

/// The session's fact that keeps them, oldest first.
inline constexpr const char* kPendingEditsKey = "pending edits";

/// Of an operation that was done, undone or done again; none: it does not concern the catalogue. `note_of`:
/// what is said of a region now.
[[nodiscard]] std::vector<CatalogueStep> catalogueStepsOf(
    const Operation& operation, EditDirection direction,
    const std::function<const RegionNote&(RegionId)>& note_of);

/// Random: no two edits of any sessions share one.
[[nodiscard]] std::string newToken();

/// With a new token.
[[nodiscard]] PendingEdit pendingEditOf(std::vector<CatalogueStep> steps);

/// As text; empty for none.
[[nodiscard]] std::string pendingEditsToJson(const std::vector<PendingEdit>& edits);
/// None for what was not written so.
[[nodiscard]] std::vector<PendingEdit> pendingEditsFromJson(const std::string& text);

}  // namespace scantrove
