#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/held_file.h"
#include "core/base/result.h"
#include "core/database/database_connection.h"

namespace scantrove {

/// session.sqlite, open, and what has become of its name: the connection goes on to work in a file that was
/// removed or moved, which nobody would find again. For the thread that opened it.
class SessionDatabase {
 public:
  /// Opens or creates, and brings the tables up to date. Error: as of DatabaseConnection and migrate().
  [[nodiscard]] static Result<SessionDatabase> open(const std::filesystem::path& file);
  SessionDatabase(SessionDatabase&&) noexcept = default;
  SessionDatabase& operator=(SessionDatabase&&) noexcept = default;

  [[nodiscard]] DatabaseConnection& operator*() const { return *connection_; }
  [[nodiscard]] DatabaseConnection* operator->() const { return connection_.get(); }

  /// False: a failure of follow() or writeAnew() left it closed.
  [[nodiscard]] bool isOpen() const { return connection_ != nullptr && main_; }
  /// The file and those that SQLite has beside it are found under their names.
  [[nodiscard]] bool isStillThere() const;
  /// Where the folder is that the file was moved with; empty: it was not moved with its folder.
  [[nodiscard]] std::filesystem::path folderItWasMovedWith() const;
  /// Opens the same file in its new folder. Error: it cannot be opened.
  [[nodiscard]] Result<void> follow(const std::filesystem::path& folder);
  /// Writes all that the connection knows anew, under the old name, or under another one where somebody's
  /// file has that by now, and works in there from then on. Error: it cannot be written.
  [[nodiscard]] Result<void> writeAnew();

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  explicit SessionDatabase(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] Result<void> connect();
  [[nodiscard]] bool isLogTaken() const;
  void disconnect();

  std::filesystem::path file_;
  std::unique_ptr<DatabaseConnection> connection_;
  std::optional<HeldFile> main_;
  std::vector<HeldFile> beside_;  // of SQLite
};

}  // namespace scantrove
