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

/// For a file whose pages or tables are not what they should be; `detail` says what.
[[nodiscard]] Error damagedDatabase(const std::string& file, const std::string& detail);

/// One connection to one SQLite file through QtSql: foreign keys, 5 s busy timeout, synchronous NORMAL (with
/// the write-ahead log, what was committed survives a killed process; a power cut may lose the last commits
/// but never damages the file). For the thread that opened it only (checked). Needs no QCoreApplication. All
/// failures name the file.
class DatabaseConnection {
 public:
  static constexpr int kBusyTimeout_ms = 5000;

  /// Opens or creates `file` and changes nothing in it: what it is shows with the first statement. Error: a
  /// folder, no such parent folder, not writable, or `postgresql://...`.
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> open(const std::string& file);
  /// Opens a file that is there to read it, and changes nothing in it. Where nobody has begun to write into
  /// it, it is read without SQLite's locks, which leave files beside it: see isStill(). Error: there is none,
  /// a folder, not readable; somebody writes into it, and nothing can be written to its folder.
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> openToRead(const std::string& file);
  /// Nobody has begun to write into a file that is read without locks: what was read belongs together. Where
  /// it is false, openToRead() and read again.
  [[nodiscard]] bool isStill() const;
  ~DatabaseConnection();
  DatabaseConnection(const DatabaseConnection&) = delete;
  DatabaseConnection& operator=(const DatabaseConnection&) = delete;

  /// Brings the file into SQLite's WAL mode, in which readers and a writer do not wait for each other.
  [[nodiscard]] Result<void> useWriteAheadLog();

  /// Runs one statement with its `?` filled in order. An active query blocks no other.
  [[nodiscard]] Result<QSqlQuery> execute(const QString& sql, const QVariantList& values = {});
  /// The same for an INSERT: the id of the new row.
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

  /// What a file shows of its changes, without being opened.
  struct Stamp {
    std::int64_t bytes = 0, seconds = 0, nanoseconds = 0;
    std::uint64_t inode = 0;
    bool operator==(const Stamp&) const = default;
  };
  /// None: somebody writes into it, or may have been interrupted.
  [[nodiscard]] static std::optional<Stamp> stampOf(const std::string& file);

  std::string file_;
  QString name_;
  std::thread::id thread_;
  std::optional<Stamp> stamp_;         // of a file that is read without locks
  int transactions_ = 0;               // begun and not ended, one inside the other
  bool has_lost_transaction_ = false;  // SQLite rolled all of it back; nothing more may be done in it
};

}  // namespace scantrove
