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

/// A scan on disk: DIR/session.sqlite, DIR/map/NNNNNN.bricks, DIR/keyframes/. Everything in it names files
/// relative to the folder, so that it may be copied and moved. For one program at a time, and the thread that
/// opened it.
///
/// What is saved is there as a whole or not at all, however the program ends: pages are appended to a file
/// first, a few at a time, then one transaction says where they are, with all else.
class SessionStore {
 public:
  /// Begins a session in `folder` (made if there is none). The session that is there, if any, stays as it is
  /// until a frame with a pose is saved: one transaction then replaces it, and its files are removed. Error:
  /// somebody has labelled it, another program has it, it is damaged, the folder cannot be written, ...
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> create(const std::filesystem::path& folder);
  /// Error: there is none, it is of a newer version, another program has it, ...
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> open(const std::filesystem::path& folder);
  /// Whether there is a session, of any version.
  [[nodiscard]] static bool isSession(const std::filesystem::path& folder);
  ~SessionStore();

  /// Writes pages that are there from the next save() on; of one that is written twice, the later. Error: the
  /// disk is full, ...
  [[nodiscard]] Result<void> writePages(std::span<const SavedPage> pages);
  /// All of it and the pages that were written for it, or nothing. Error: the disk is full, ...
  [[nodiscard]] Result<void> save(const SavedDelta& delta);
  /// Between two saves: one frame and its images. Error: the disk is full, ...
  [[nodiscard]] Result<void> saveKeyFrame(const SavedFrame& frame, const SavedKeyFrame& images);
  /// A name for an image of the session, in its folder and still free: `stem` and `ending` in keyframes/. It
  /// is on record before the file is made. Error: the database.
  [[nodiscard]] Result<std::filesystem::path> claimImage(const std::string& stem, const std::string& ending);

  /// The map is given up, with all that is known of it; frames stay. What is written by then for the next
  /// save() goes, too. Error: the database; its rows are there as before.
  [[nodiscard]] Result<void> forgetMap();

  /// All but the map. What is damaged is left out and named in `damages`.
  [[nodiscard]] Result<SavedScan> load();
  /// A page of the map. Error: it is damaged.
  [[nodiscard]] Result<std::vector<std::uint32_t>> loadPage(const Eigen::Vector3i& position);
  /// None: the scan broke off before it was kept, or it is damaged.
  [[nodiscard]] Result<std::optional<SavedCamera>> loadCamera();
  [[nodiscard]] const std::vector<std::string>& damages() const { return damages_; }

  /// Looks whether other programs have removed, moved or replaced files of the session, and writes them anew
  /// or follows the folder. None: all is in place. Error: it could not be written anew.
  [[nodiscard]] Result<std::optional<Error>> keepInPlace();
  /// Images that the session names and that went since it was opened; none: no others than then.
  [[nodiscard]] Result<std::optional<Error>> findLostImages();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  SessionStore(std::filesystem::path folder, FileLock lock)
      : folder_(std::move(folder)), map_(folder_), lock_(std::move(lock)) {}

  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> openLocked(const std::filesystem::path& folder);
  /// Error: somebody has labelled it.
  [[nodiscard]] Result<void> beginReplacing();
  /// Whether it is too early to replace an earlier session: then it is kept for later.
  [[nodiscard]] bool waitsWith(const SavedDelta& delta);
  [[nodiscard]] Result<void> write(const SavedDelta& delta, bool with_pages);
  [[nodiscard]] Result<void> writeRows(const SavedDelta& delta, bool with_pages);
  /// The file that is locked is found under its name.
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
  std::vector<SavedDelta> waiting_;  // until then
  int lost_before_ = 0;              // images, when it was opened
  std::vector<std::string> damages_;
};

}  // namespace scantrove
