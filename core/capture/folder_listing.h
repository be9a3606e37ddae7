#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// The names in a folder, sorted, hidden ones left out. Error: names the folder and the system's reason.
[[nodiscard]] Result<std::vector<std::string>> listFolder(const std::filesystem::path& folder);

/// The parts of `frame-000012.depth.png`.
struct SevenScenesPart {
  int number = 0;
  std::string_view suffix;  ///< "depth.png"; points into the name
};

/// Empty if `name` is not of the form `frame-<digits>.<suffix>`.
[[nodiscard]] std::optional<SevenScenesPart> sevenScenesPart(std::string_view name);

/// The folder's name, also for paths that end in a slash or are ".".
[[nodiscard]] std::string folderName(const std::filesystem::path& folder);

/// The folder that contains `folder`, also for paths that end in a slash or are ".".
[[nodiscard]] std::filesystem::path parentOf(const std::filesystem::path& folder);

/// `text` in lower case (ASCII).
[[nodiscard]] std::string lowerCase(std::string_view text);

}  // namespace scantrove
