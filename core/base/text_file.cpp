#include "core/base/text_file.h"

#include <string_view>

#include "core/base/regular_file.h"

namespace scantrove {

Result<std::string> readTextFile(const std::filesystem::path& file) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF", kLittleEndian = "\xFF\xFE", kBigEndian = "\xFE\xFF";
  Result<std::string> text = readFile(file);
  if (!text) return text;
  if (text->starts_with(kLittleEndian) || text->starts_with(kBigEndian)) {
    return fail(file.string() + " is a text of 16 bits a letter.", "Save it as UTF-8.");
  }
  if (text->starts_with(kMark)) text->erase(0, kMark.size());
  return text;
}

}  // namespace scantrove
