#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

class CatalogueModel;

/// The effect of an import.
struct ClassImport {
  int added = 0, updated = 0, unchanged = 0;
  std::vector<std::string> conflicts;  ///< sentences: what was not taken over, and why
};

/// Adds the classes of a list and updates known ones; no class gets another id:
/// - A class of that name is updated, and a hidden one returns. It keeps its id.
/// - Else a class of that id gets the name, unless objects have it: that is a conflict.
/// - Else the class is added, with the id of the list or the next free one.
/// Error: a class is not valid (checkedDraft).
[[nodiscard]] Result<ClassImport> importClasses(CatalogueModel& catalogue, std::span<const ClassDraft> list);

}  // namespace scantrove
