#include "core/session/inside_folder.h"

#include <algorithm>
#include <system_error>

namespace scantrove {

bool isInsideFolder(const std::filesystem::path& folder, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  if (file.empty() || file.is_absolute()) return false;
  std::error_code folder_failure, file_failure, ignored;
  const fs::path root = fs::canonical(folder, folder_failure);
  const fs::path place = fs::weakly_canonical(root / file, file_failure);
  if (folder_failure || file_failure) return false;
  const auto [of_root, of_place] = std::ranges::mismatch(root, place);
  if (of_root != root.end() || of_place == place.end()) return false;
  // Reading a pipe or a device would block.
  const fs::file_status status = fs::status(place, ignored);
  return status.type() == fs::file_type::regular || status.type() == fs::file_type::not_found;
}

}  // namespace scantrove
