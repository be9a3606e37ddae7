#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

// Lists of classes as files: JSON (`categories` of COCO) and CSV (docs/formats.md).

inline constexpr std::size_t kLargestClassList = std::size_t{16} << 20U;  ///< bytes
inline constexpr std::size_t kMostListedClasses = 10'000;

/// `{"categories": [{"id", "name", "supercategory", "scantrove": {"color": "#rrggbb", "attributes":
/// [...]}}]}`.
[[nodiscard]] std::string classListToJson(std::span<const ObjectClass> classes);
/// `id,name,supercategory,color`, a line for each class; quoted as in RFC 4180. It has no attributes.
[[nodiscard]] std::string classListToCsv(std::span<const ObjectClass> classes);

/// Parses either form; `file`: how messages call it. Other members of a COCO file are skipped, and only
/// "name" must be given. Error: another form, an id outside 1 to kLargestClassId, an id or a name twice, a
/// class that is not valid (checkedDraft), or too many of them.
[[nodiscard]] Result<std::vector<ClassDraft>> parseClassList(std::string_view text, const std::string& file);
/// Reads a file of at most kLargestClassList bytes. Error: names it; as parseClassList().
[[nodiscard]] Result<std::vector<ClassDraft>> readClassList(const std::filesystem::path& file);

}  // namespace scantrove
