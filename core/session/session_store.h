#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/file_lock.h"
#include "core/base/held_file.h"
#include "core/base/result.h"
#include "core/session/map_files.h"
#include "core/session/saved_scan.h"
#include "core/session/session_database.h"

namespace scantrove {

/// A scan on disk: DIR/session.sqlite, DIR/map/NNNNNN.bricks, DIR/keyframes/. File names in it are relative
/// to the folder, so it can be copied and moved. For one program at a time, and the thread that opened it.
///
/// Each save is atomic, however the program ends: pages are first appended to a file, a few at a time. Then
/// one transaction stores their positions with all other data.
class SessionStore {
 public:
  /// Starts a session in `folder`, which is created if missing. An existing session stays until a frame
  /// with a pose is saved: one transaction then replaces it, and its files are removed. Error: a user has
  /// labelled it, another program has it open, it is damaged, the folder is not writable, ...
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> create(const std::filesystem::path& folder);
  /// Opens a session. Error: missing, of a newer version, open in another program, ...
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> open(const std::filesystem::path& folder);
  /// Whether there is a session, of any version.
  [[nodiscard]] static bool isSession(const std::filesystem::path& folder);
  ~SessionStore();

  /// Writes pages that become visible with the next save(); the last of several versions counts. Error: the
  /// disk is full, ...
  [[nodiscard]] Result<void> writePages(std::span<const SavedPage> pages);
  /// Saves the delta and the pages written for it, atomically. Error: the disk is full, ...
  [[nodiscard]] Result<void> save(const SavedDelta& delta);
  /// Saves one frame and its images between two saves. Error: the disk is full, ...
  [[nodiscard]] Result<void> saveKeyFrame(const SavedFrame& frame, const SavedKeyFrame& images);
  /// Reserves a free name for an image of the session: `stem` and `ending` in keyframes/. It is recorded
  /// before the file is created. Error: the database.
  [[nodiscard]] Result<std::filesystem::path> claimImage(const std::string& stem, const std::string& ending);

  /// Drops the map with all its data; frames stay. Pages written for the next save() are dropped, too.
  /// Error: the database; its rows are unchanged.
  [[nodiscard]] Result<void> forgetMap();

  /// Reads everything but the map. Damaged data is left out and named in `damages`.
  [[nodiscard]] Result<SavedScan> load();
  /// A page of the map. Error: it is damaged.
  [[nodiscard]] Result<std::vector<std::uint32_t>> loadPage(const Eigen::Vector3i& position);
  /// None: the scan was interrupted before it was stored, or it is damaged.
  [[nodiscard]] Result<std::optional<SavedCamera>> loadCamera();
  [[nodiscard]] const std::vector<std::string>& damages() const { return damages_; }

  /// Checks whether other programs have removed, moved or replaced files of the session, and writes them
  /// again or follows the folder. None: nothing changed. Error: writing again failed.
  [[nodiscard]] Result<std::optional<Error>> keepInPlace();
  /// Images that went missing since the session was opened; none: no further ones.
  [[nodiscard]] Result<std::optional<Error>> findLostImages();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  SessionStore(std::filesystem::path folder, FileLock lock)
      : folder_(std::move(folder)), map_(folder_), lock_(std::move(lock)) {}

  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> openLocked(const std::filesystem::path& folder);
  /// Error: a user has labelled it.
  [[nodiscard]] Result<void> beginReplacing();
  /// Whether it is too early to replace an earlier session: then the delta waits.
  [[nodiscard]] bool waitsWith(const SavedDelta& delta);
  [[nodiscard]] Result<void> write(const SavedDelta& delta, bool with_pages);
  [[nodiscard]] Result<void> writeRows(const SavedDelta& delta, bool with_pages);
  /// Whether the locked file still has its name.
  [[nodiscard]] bool isLocked() const;
  [[nodiscard]] Result<void> takeLock();
  [[nodiscard]] Result<Error> writeAnew();
  [[nodiscard]] Result<int> countLostImages() const;
  /// In a transaction.
  [[nodiscard]] Result<void> deleteMapRows();

  std::filesystem::path folder_;
  MapFiles map_;
  FileLock lock_;
  std::optional<HeldFile> lock_file_;
  std::optional<SessionDatabase> database_;
  bool replaces_ = false;            // an earlier session, with the first frame that has a pose
  std::vector<SavedDelta> waiting_;  // until that frame
  int lost_before_ = 0;              // missing images when it was opened
  std::vector<std::string> damages_;
};

}  // namespace scantrove
