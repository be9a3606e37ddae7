#pragma once
#include <QSqlQuery>
#include <QString>
#include <QVariant>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/base/result.h"
#include "core/database/sql_dialect.h"
#include "core/database/sqlite_file.h"

class QSqlDriver;

namespace scantrove {

/// Error for a file with invalid pages or tables; `detail` says which.
[[nodiscard]] Error damagedDatabase(const std::string& file, const std::string& detail);

/// One connection through QtSql. Use on the opening thread only (checked). Needs no QCoreApplication. All
/// errors name the file or the server's address.
/// - A SQLite file: foreign keys, 5 s busy timeout, synchronous NORMAL. With the write-ahead log, commits
///   survive a killed process; a power cut may lose the last commits but never damages the file.
/// - A database of a PostgreSQL server (ServerAddress): a statement waits at most 5 s for a lock. A lost
///   connection is made again by the next statement outside a transaction, at most once a second; where
///   failing takes long, once in ten times that.
class DatabaseConnection {
 public:
  static constexpr int kBusyTimeout_ms = 5000;

  /// Opens or creates `database` without changing it; the first statement reveals an invalid file. Error: a
  /// folder, no such parent folder, not writable; no server, no such database, no access.
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> open(const std::string& database);
  /// Opens an existing database read-only. If nobody is writing to a file, reads without SQLite's locks,
  /// which create files beside it: see isStill(). Error: no such file, a folder, not readable; or somebody is
  /// writing to it and its folder is not writable; as open().
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> openToRead(const std::string& database);
  /// Whether nobody has started writing to a file that is read without locks, so that the data read is
  /// consistent. If false, call openToRead() and read again.
  [[nodiscard]] bool isStill() const;
  ~DatabaseConnection();
  DatabaseConnection(const DatabaseConnection&) = delete;
  DatabaseConnection& operator=(const DatabaseConnection&) = delete;

  /// Switches a file to SQLite's WAL mode, in which readers and a writer do not block each other. Nothing
  /// for a server, which works so.
  [[nodiscard]] Result<void> useWriteAheadLog();

  /// Runs one statement with its `?` bound in order. An active query blocks no other.
  [[nodiscard]] Result<QSqlQuery> execute(const QString& sql, const QVariantList& values = {});
  /// Runs an INSERT into a table with a column `id`, and returns that of the new row.
  [[nodiscard]] Result<std::int64_t> insert(const QString& sql, const QVariantList& values);

  /// Others that listen (ServerNotifications) learn of the open transaction with its commit.
  void announceChange() { is_change_announced_ = true; }

  /// For signals; it stays the same when a lost connection is made again.
  [[nodiscard]] QSqlDriver* driver() const;

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] SqlDialect dialect() const { return dialect_; }
  [[nodiscard]] bool isOnServer() const { return dialect_ == SqlDialect::postgresql; }

  /// ISO 8601 with milliseconds, UTC.
  [[nodiscard]] static QString now();

 private:
  friend class ReadSnapshot;
  friend class Transaction;
  enum class Use { read, write };
  DatabaseConnection() = default;
  [[nodiscard]] static std::unique_ptr<DatabaseConnection> named(const std::string& database,
                                                                 SqlDialect dialect);
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> connect(const std::string& file,
                                                                           const QString& name_of_file,
                                                                           const QString& options);
  [[nodiscard]] static Result<std::unique_ptr<DatabaseConnection>> connectToServer(const std::string& url,
                                                                                   Use use);

  [[nodiscard]] Result<QSqlQuery> executeInFile(const QString& sql, const QVariantList& values);
  [[nodiscard]] Result<QSqlQuery> executeOnServer(const QString& sql, const QVariantList& values);
  /// Connects again if the connection is lost. Error: no server; or the loss ended an open transaction.
  [[nodiscard]] Result<void> reconnect();

  /// What is known of a server's connection and its open transaction.
  struct ServerState {
    bool is_lost = false;
    bool has_conflict = false;     ///< the transaction may be tried again
    bool is_aborted = false;       ///< a statement failed; a COMMIT would roll back without an error
    std::optional<Error> refusal;  ///< of the last attempt to connect
    std::chrono::steady_clock::time_point next_attempt;
  };

  std::string file_;
  QString name_;
  SqlDialect dialect_ = SqlDialect::sqlite;
  std::thread::id thread_;
  std::optional<sqlite::Stamp> stamp_;  // of a file that is read without locks
  int transactions_ = 0;                // open transactions, nested
  bool has_lost_transaction_ = false;  // it was rolled back completely; no further statement is allowed in it
  bool is_change_announced_ = false;
  ServerState server_;
};

}  // namespace scantrove
