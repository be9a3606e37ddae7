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

/// The open session.sqlite, and a check of its name: SQLite would continue in a removed or moved file,
/// which users would not find again. For the thread that opened it.
class SessionDatabase {
 public:
  /// Opens or creates the file and migrates its tables. Error: as of DatabaseConnection and migrate().
  [[nodiscard]] static Result<SessionDatabase> open(const std::filesystem::path& file);
  SessionDatabase(SessionDatabase&&) noexcept = default;
  SessionDatabase& operator=(SessionDatabase&&) noexcept = default;

  [[nodiscard]] DatabaseConnection& operator*() const { return *connection_; }
  [[nodiscard]] DatabaseConnection* operator->() const { return connection_.get(); }

  /// False: a failure of moveTo() or writeAnew() left it closed.
  [[nodiscard]] bool isOpen() const { return connection_ != nullptr && main_; }
  /// Whether the file and SQLite's files beside it still have their names.
  [[nodiscard]] bool isStillThere() const;
  /// The new folder if the file was moved with its folder; else empty.
  [[nodiscard]] std::filesystem::path folderItWasMovedWith() const;
  /// Opens the same file in its new folder. Error: it cannot be opened.
  [[nodiscard]] Result<void> moveTo(const std::filesystem::path& folder);
  /// Writes the connection's whole content to a new file with the old name, or another if the name is
  /// taken, and continues there. Error: writing failed.
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
  std::vector<HeldFile> beside_;  // SQLite's files
};

}  // namespace scantrove
