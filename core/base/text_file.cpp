#include "core/base/text_file.h"

#include <cstdint>
#include <string_view>
#include <system_error>

#include "core/base/regular_file.h"

namespace scantrove {

Result<std::string> readTextFile(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{512} << 20;
  std::error_code unknown;  // readFile() says why
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  if (!unknown && bytes > kMostBytes)
    return fail(file.string() + " is larger than 512 MB: too large for a text.", "Is it the right file?");
  constexpr std::string_view kMark = "\xEF\xBB\xBF", kLittleEndian = "\xFF\xFE", kBigEndian = "\xFE\xFF";
  Result<std::string> text = readFile(file, kMostBytes);
  if (!text) return text;
  if (text->starts_with(kLittleEndian) || text->starts_with(kBigEndian)) {
    return fail(file.string() + " is a text of 16 bits a letter.", "Save it as UTF-8.");
  }
  if (text->starts_with(kMark)) text->erase(0, kMark.size());
  return text;
}

}  // namespace scantrove
