#pragma once
#include <QString>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

/// Attributes of a class in one line: "material: wood, steel; broken: yes/no; remark".
[[nodiscard]] QString attributesToText(const std::vector<ClassAttribute>& attributes);
/// Reads such a line; the class checks names and choices (checkedDraft). Error: an attribute without a name.
[[nodiscard]] Result<std::vector<ClassAttribute>> attributesFromText(const QString& text);

}  // namespace scantrove
