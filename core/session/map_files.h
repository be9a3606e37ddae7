#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/geometry/position_order.h"
#include "core/session/record_file.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// The map of a session: DIR/map/NNNNNN.bricks with the records of its pages, and the table `pages` with
/// the position of each page's newest record. For the thread of its database.
class MapFiles {
 public:
  explicit MapFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Reads the positions of all pages and opens the existing files. Damaged entries are left out and named
  /// in `damages`.
  [[nodiscard]] Result<void> read(DatabaseConnection& database, std::vector<std::string>& damages);
  /// Starts another map in new files.
  void restart();

  /// Appends a page. It becomes visible with the next commit(); the last of several versions counts.
  [[nodiscard]] Result<void> add(DatabaseConnection& database, const SavedPage& page);
  /// Syncs appended records to disk, which must precede their positions.
  [[nodiscard]] Result<void> flush();
  /// In a transaction: stores the positions of appended pages.
  [[nodiscard]] Result<void> writeLocations(DatabaseConnection& database) const;
  /// The transaction succeeded.
  void commit();

  [[nodiscard]] std::vector<Eigen::Vector3i> positions() const;
  /// Error: the page is damaged.
  [[nodiscard]] Result<std::vector<std::uint32_t>> load(const Eigen::Vector3i& position);

  /// Rewrites the map without outdated records if these are large.
  [[nodiscard]] Result<void> compact(DatabaseConnection& database);

  /// Whether all open files still have their names.
  [[nodiscard]] bool areStillThere() const;
  /// Copies pages of missing files into new files. Error: the disk failed, or a file is damaged.
  [[nodiscard]] Result<void> writeLostAnew(DatabaseConnection& database);
  /// The folder was moved.
  void moveTo(const std::filesystem::path& folder);

 private:
  struct PageLocation {
    std::int64_t file = 0;
    std::uint64_t offset = 0;
    std::uint32_t bytes = 0, unpacked_bytes = 0;
    std::uint64_t checksum = 0;
  };
  using Pages = std::map<Eigen::Vector3i, PageLocation, PositionOrder>;

  [[nodiscard]] std::filesystem::path pathOf(std::int64_t number) const;
  [[nodiscard]] Result<RecordFile*> fileToRead(std::int64_t number);
  [[nodiscard]] Result<RecordFile*> fileToAppend(DatabaseConnection& database);
  [[nodiscard]] Result<PageLocation> append(DatabaseConnection& database, const PackedWords& packed);
  [[nodiscard]] Result<void> writeLocations(DatabaseConnection& database, const Pages& pages) const;
  /// Moves pages to the file for appending. Unreadable pages keep their positions.
  [[nodiscard]] Result<Pages> copyPages(DatabaseConnection& database, const Pages& pages);
  /// Moves all pages to new files. Error: the disk failed; the old files still hold the pages.
  [[nodiscard]] Result<void> movePages(DatabaseConnection& database, const std::set<std::int64_t>& old);
  [[nodiscard]] std::uint64_t liveBytes() const;
  /// Map files that the session created.
  [[nodiscard]] Result<std::set<std::int64_t>> ownNumbers(DatabaseConnection& database) const;

  std::filesystem::path folder_;
  Pages pages_;
  Pages added_;                               // for the next commit()
  std::map<std::int64_t, RecordFile> files_;  // open files
  std::optional<std::int64_t> appended_;      // file for appending
  std::int64_t last_number_ = 0;
  std::set<std::int64_t> unflushed_;
  bool has_new_file_ = false;
};

}  // namespace scantrove
