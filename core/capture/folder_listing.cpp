#include "core/capture/folder_listing.h"

#include <algorithm>
#include <system_error>

#include "core/base/text.h"

namespace scantrove {

Result<std::vector<std::string>> listFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (std::string name = entry->path().filename().string(); name.front() != '.') {
      names.push_back(std::move(name));
    }
  }
  if (error) {
    return fail("Cannot read the folder " + folder.string() + ": " + error.message() + ".",
                "Check the path and its permissions.");
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<SevenScenesPart> sevenScenesPart(std::string_view name) {
  constexpr std::string_view kPrefix = "frame-";
  const std::size_t dot = name.find('.');
  if (!name.starts_with(kPrefix) || dot == std::string_view::npos) {
    return std::nullopt;
  }
  const auto number = parseFrameNumber(name.substr(kPrefix.size(), dot - kPrefix.size()));
  if (!number) {
    return std::nullopt;
  }
  return SevenScenesPart{*number, name.substr(dot + 1)};
}

std::string folderName(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(folder, error).lexically_normal();
  const std::filesystem::path& path = error ? folder : absolute;
  return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

std::filesystem::path parentOf(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(folder, error).lexically_normal();
  const std::filesystem::path& path = error ? folder : absolute;
  return path.has_filename() ? path.parent_path() : path.parent_path().parent_path();
}

std::string lowerCase(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

}  // namespace scantrove
