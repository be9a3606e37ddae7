#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace scantrove {

// What killed programs leave of a StagedFolder: folders `NAME.part-XXXXXX` beside it, known by their marker.

inline constexpr std::string_view kStagedSuffix = ".part-";
inline constexpr std::size_t kStagedLetters = 6;

/// The marker's content. It names the staged folder, so that a renamed copy does not count as ours.
[[nodiscard]] std::string stagedMarkerOf(const std::filesystem::path& part);
/// That of an old data set that was moved to `part`, until the new one is in its place.
[[nodiscard]] std::string replacedMarkerOf(const std::filesystem::path& part);

/// Whether the marker in `folder` is one that this program wrote, for whichever folder. A file that only has
/// its name is a user's.
[[nodiscard]] bool hasOurMarker(const std::filesystem::path& folder);

/// Removes the marker, if it is one of ours.
void removeOurMarker(const std::filesystem::path& folder);

/// Writes a marker, in place of an earlier one of ours. False: it failed; errno says why (EEXIST: a file of
/// somebody else has its name).
[[nodiscard]] bool writeStagedMarker(const std::filesystem::path& folder, const std::string& text);

/// An open descriptor of a folder, to lock it; -1: there is none.
[[nodiscard]] int openStagedFolder(const std::filesystem::path& folder);

/// Puts an old data set back into `place` if a program was killed while it replaced it.
void restoreReplacedFolder(const std::filesystem::path& place);

/// Removes the folders that killed programs left beside `place`: those with our marker that nobody has
/// locked. Of a complete data set it removes only the files of its record.
void removeAbandonedFolders(const std::filesystem::path& place);

}  // namespace scantrove
