#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/file_lock.h"
#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/record_file.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// A scan on disk: DIR/session.sqlite, DIR/map/NNNNNN.bricks, DIR/keyframes/. Everything in it names files
/// relative to the folder, so that it may be copied and moved. For one program at a time, and the thread that
/// opened it.
///
/// What is saved is there as a whole or not at all, however the program ends: pages are appended to a file
/// first, a few at a time, then one transaction says where they are, with all else.
class SessionStore {
 public:
  /// Begins a session in `folder` (made if there is none). Removes the files of the session that is there,
  /// unless somebody has labelled it. Error: as checkReplaceable(), the folder cannot be written, ...
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> create(const std::filesystem::path& folder);
  /// Error: there is none, it is of a newer version, another program has it, ...
  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> open(const std::filesystem::path& folder);
  /// Error: the session in `folder` must not be replaced: somebody has labelled it, another program has it,
  /// or it is damaged.
  [[nodiscard]] static Result<void> checkReplaceable(const std::filesystem::path& folder);
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

  /// All but the map. What is damaged is left out and named in `damages`.
  [[nodiscard]] Result<SavedScan> load();
  /// A page of the map. Error: it is damaged.
  [[nodiscard]] Result<std::vector<std::uint32_t>> loadPage(const Eigen::Vector3i& position);
  /// None: the scan broke off before it was kept, or it is damaged.
  [[nodiscard]] Result<std::optional<SavedCamera>> loadCamera();
  [[nodiscard]] const std::vector<std::string>& damages() const { return damages_; }

  /// Writes the map anew without what is outdated, if that is much.
  [[nodiscard]] Result<void> compact();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path keyFrameFolder() const { return folder_ / "keyframes"; }

 private:
  struct PagePlace {
    std::int64_t file = 0;
    std::uint64_t offset = 0;
    std::uint32_t bytes = 0, unpacked_bytes = 0;
    std::uint64_t checksum = 0;
  };
  struct ByPosition {
    bool operator()(const Eigen::Vector3i& a, const Eigen::Vector3i& b) const {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    }
  };
  using Pages = std::map<Eigen::Vector3i, PagePlace, ByPosition>;

  SessionStore(std::filesystem::path folder, FileLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}

  [[nodiscard]] static Result<std::unique_ptr<SessionStore>> openLocked(const std::filesystem::path& folder);
  [[nodiscard]] Result<void> readPlaces();
  [[nodiscard]] Result<RecordFile*> file(std::int64_t number);
  /// Error: it is missing; none is made.
  [[nodiscard]] Result<RecordFile*> fileToRead(std::int64_t number);
  [[nodiscard]] Result<PagePlace> append(const PackedWords& packed);
  [[nodiscard]] Result<void> writeRows(const SavedDelta& delta);
  [[nodiscard]] Result<void> writePlaces(const Pages& pages);
  /// Moves all pages to new files of the map. False: a reader of the database keeps their places from the
  /// disk. Error: the disk failed; the old files still hold the pages.
  [[nodiscard]] Result<bool> movePages();
  [[nodiscard]] std::filesystem::path fileName(std::int64_t number) const;
  [[nodiscard]] std::uint64_t liveBytes() const;
  /// Of the map's files on disk.
  [[nodiscard]] std::vector<std::int64_t> fileNumbers() const;

  std::filesystem::path folder_;
  FileLock lock_;
  std::unique_ptr<DatabaseConnection> database_;
  Pages pages_;
  Pages written_;                             // for the next save
  std::map<std::int64_t, RecordFile> files_;  // that are open
  std::int64_t current_ = 1;                  // the file that is appended to
  std::vector<std::string> damages_;
};

}  // namespace scantrove
