#pragma once
#include <QSqlQuery>
#include <QString>
#include <QVariant>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/base/result.h"

namespace scantrove {

/// Error for a file with invalid pages or tables; `detail` says which.
[[nodiscard]] Error damagedDatabase(const std::string& file, const std::string& detail);

/// One connection to one SQLite file through QtSql: foreign keys, 5 s busy timeout, synchronous NORMAL. With
/// the write-ahead log, commits survive a killed process; a power cut may lose the last commits but never
/// damages the file. Use on the opening thread only (checked). Needs no QCoreApplication. All errors name the
/// file.
class DatabaseConnection {
 public:
  static constexpr int kBusyTimeout_ms = 5000;

  /// Opens or creates `file` without changing it; the first statement reveals an invalid file. Error: a
  /// folder, no such parent folder, not writable, or `postgresql://...`.
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> open(const std::string& file);
  /// Opens an existing file read-only. If nobody is writing to it, reads without SQLite's locks, which create
  /// files beside it: see isStill(). Error: no such file, a folder, not readable; or somebody is writing to
  /// it and its folder is not writable.
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> openToRead(const std::string& file);
  /// Whether nobody has started writing to a file that is read without locks, so that the data read is
  /// consistent. If false, call openToRead() and read again.
  [[nodiscard]] bool isStill() const;
  ~DatabaseConnection();
  DatabaseConnection(const DatabaseConnection&) = delete;
  DatabaseConnection& operator=(const DatabaseConnection&) = delete;

  /// Switches the file to SQLite's WAL mode, in which readers and a writer do not block each other.
  [[nodiscard]] Result<void> useWriteAheadLog();

  /// Runs one statement with its `?` bound in order. An active query blocks no other.
  [[nodiscard]] Result<QSqlQuery> execute(const QString& sql, const QVariantList& values = {});
  /// Runs an INSERT and returns the id of the new row.
  [[nodiscard]] Result<std::int64_t> insert(const QString& sql, const QVariantList& values);

  [[nodiscard]] const std::string& file() const { return file_; }

  /// ISO 8601 with milliseconds, UTC.
  [[nodiscard]] static QString now();

 private:
  friend class Transaction;
  DatabaseConnection() = default;
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> connect(const std::string& file,
                                                                           const QString& name_of_file,
                                                                           const QString& options);

  /// State of a file that reveals changes without opening it.
  struct Stamp {
    std::int64_t bytes = 0, seconds = 0, nanoseconds = 0;
    std::uint64_t inode = 0;
    bool operator==(const Stamp&) const = default;
  };
  /// None: somebody is writing to it, or may have been interrupted.
  [[nodiscard]] static std::optional<Stamp> stampOf(const std::string& file);

  std::string file_;
  QString name_;
  std::thread::id thread_;
  std::optional<Stamp> stamp_;  // of a file that is read without locks
  int transactions_ = 0;        // open transactions, nested
  bool has_lost_transaction_ =
      false;  // SQLite rolled it back completely; no further statement is allowed in it
};

}  // namespace scantrove
