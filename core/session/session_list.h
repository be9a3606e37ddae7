#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/session/saved_scan.h"

namespace scantrove {

/// A session as a list shows it: what its tables say, without its map.
struct SessionSummary {
  std::filesystem::path folder;
  std::string name;               ///< the folder's
  std::string source;             ///< as it was given to the scan
  std::string database;           ///< its catalogue, as the session keeps the name
  std::string started;            ///< ISO 8601, UTC; empty: not known
  std::filesystem::path picture;  ///< colour image of the key frame in the middle; empty: there is none
  int frames = 0, tracked = 0, key_frames = 0;
  int regions = 0;                 ///< of at least kSmallFragmentVoxels voxels
  int objects = 0;                 ///< of the catalogue, that regions are
  std::vector<std::string> names;  ///< of regions, by the alphabet, each once
  bool ended = false;              ///< the scan came to its end
  bool in_use = false;             ///< a program has it open; false where the system does not tell
  double megabytes = 0;            ///< of all files in its folder
  std::string damage;              ///< why nothing else is known, a sentence; empty: all is well

  /// The scan broke off, and what it had kept is there.
  [[nodiscard]] bool isRecovered() const { return damage.empty() && !ended && !in_use; }
};

/// The session in `folder`, if there is one, and those in the folders in it, newest first. Takes milliseconds
/// for each, and nothing from the programs that have them open; changes nothing. What cannot be read is there
/// with its `damage`. No folder: none. Any thread.
[[nodiscard]] std::vector<SessionSummary> listSessions(const std::filesystem::path& folder);

/// The metadata of the session in `folder`, read as listSessions() reads it. Empty: there is no session, or
/// it cannot be read. Any thread.
[[nodiscard]] SessionMetadata readSessionMetadata(const std::filesystem::path& folder);

/// Where scans are kept unless somebody says otherwise: $XDG_DATA_HOME/scantrove/scans, or below
/// ~/.local/share. Need not be there.
[[nodiscard]] std::filesystem::path defaultScansFolder();

}  // namespace scantrove
