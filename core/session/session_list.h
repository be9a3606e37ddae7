#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/review_state.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// A session as listed: data of its tables, without its map.
struct SessionSummary {
  std::filesystem::path folder;
  std::string name;               ///< the folder's
  std::string source;             ///< as given to the scan
  std::string part;               ///< of the recording: partInWords(); empty: unknown
  std::string database;           ///< its catalogue, as stored in the session
  std::string started;            ///< ISO 8601, UTC; empty: unknown
  std::filesystem::path picture;  ///< colour image of the middle key frame; empty: none
  int frames = 0, tracked = 0, key_frames = 0;
  ReviewCounts reviews;            ///< of key frames with a pose
  int regions = 0;                 ///< of at least kSmallFragmentVoxels voxels
  int objects = 0;                 ///< objects of the catalogue among its regions
  std::vector<std::string> names;  ///< of regions, sorted, without duplicates
  bool ended = false;              ///< the scan reached its end
  bool can_be_refined = false;     ///< its refinement was skipped, or it was interrupted before
  bool read_to_end = false;        ///< its source was read to the end; false in scans of older versions
  bool in_use = false;             ///< a program has it open; false if the system cannot tell
  double megabytes = 0;            ///< all files in its folder
  std::string damage;              ///< why it cannot be read, a sentence; empty: no damage

  /// The scan was interrupted and its stored part exists.
  [[nodiscard]] bool isRecovered() const { return damage.empty() && !ended && !in_use; }
};

/// The session in `folder` and those in its subfolders, newest first. Takes milliseconds for each, does not
/// disturb programs that have them open, and changes nothing. Unreadable sessions are listed with their
/// `damage`. Missing folder: empty. Any thread.
[[nodiscard]] std::vector<SessionSummary> listSessions(const std::filesystem::path& folder);

/// Whether a program has the session in `folder` open; false if the system cannot tell. Any thread.
[[nodiscard]] bool isSessionInUse(const std::filesystem::path& folder);

/// The metadata of the session in `folder`, read as by listSessions(). Empty: no session, or unreadable.
/// Any thread.
[[nodiscard]] SessionMetadata readSessionMetadata(const std::filesystem::path& folder);

/// The default folder of scans: $XDG_DATA_HOME/scantrove/scans, or below ~/.local/share. May not exist.
[[nodiscard]] std::filesystem::path defaultScansFolder();

}  // namespace scantrove
