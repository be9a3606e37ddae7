#pragma once
#include <QSqlQuery>
#include <QString>
#include <QVariant>
#include <initializer_list>
#include <memory>
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
  DatabaseConnection() = default;

  std::string file_;
  QString name_;
  std::thread::id thread_;
};

}  // namespace scantrove
