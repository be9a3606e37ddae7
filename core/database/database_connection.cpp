#include "core/database/database_connection.h"

#include <sys/stat.h>
#include <unistd.h>

#include <QByteArray>
#include <QDateTime>
#include <QSqlDatabase>
#include <QSqlError>
#include <atomic>
#include <chrono>
#include <filesystem>

#include "core/base/check.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

// SQLite's primary result codes (sqlite.org/rescode.html); QtSql returns the extended ones.
enum SqliteCode {
  kError = 1,
  kBusy = 5,
  kLocked = 6,
  kReadOnly = 8,
  kIo = 10,
  kCorrupt = 11,
  kFull = 13,
  kCannotOpen = 14,
  kNotADb = 26
};

constexpr std::uintmax_t kSmallestDatabase = 512;  // bytes: one page

Error notADatabase(const std::string& file) {
  return {"The file " + file + " is not a database.",
          "Give another file, or restore this one from a backup."};
}

Error describe(const std::string& file, const QSqlError& error) {
  const std::string detail = error.databaseText().toStdString();
  switch (error.nativeErrorCode().toInt() & 0xff) {
    case kBusy:
    case kLocked:
      return {"The database " + file + " is locked by another program (waited 5 s).",
              "Close the program that holds it, or use a copy of the file."};
    case kReadOnly:
      return {"The database " + file + " cannot be written (" + detail + ").",
              "Give write permission to the file and to its folder, or use a copy."};
    case kIo:
      return {"Reading or writing the database " + file + " failed (" + detail + ").",
              "Check the disk and its free space."};
    case kCorrupt:
      return damagedDatabase(file, detail);
    case kFull:
      return {"The disk is full: the database " + file + " could not be written.",
              "Free some space and try again."};
    case kCannotOpen:
      return {"The database " + file + " cannot be opened (" + detail + ").",
              "Check that its folder exists and that you may write there."};
    case kNotADb:
      return notADatabase(file);
    case kError:
      if (detail.starts_with("no such table") || detail.find("no such column") != std::string::npos ||
          detail.find("has no column") != std::string::npos) {
        return damagedDatabase(file, detail);
      }
      [[fallthrough]];
    default:
      return {"The database " + file + " refused an operation (" + detail + ").",
              "Check the file with: sqlite3 FILE 'PRAGMA integrity_check'"};
  }
}

Result<void> checkExisting(const std::string& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    return fail(file + " is not a regular file.", "Give the name of a database file.");
  if (::access(file.c_str(), R_OK | W_OK) != 0) {
    return fail("You may not read and write the database " + file + ".",
                "Change its permissions, or use a copy.");
  }
  // SQLite treats a file of one byte as empty, and would overwrite it.
  const std::uintmax_t size = fs::file_size(file, ignored);
  if (size > 0 && size < kSmallestDatabase) return fail(notADatabase(file));
  return {};
}

/// Checks the path only. Even reading the header is left to SQLite; the class comment of ObjectDatabase says
/// why.
Result<void> checkPath(const std::string& file) {
  if (file.empty()) return fail("No database was named.", "Give the name of a file.");
  if (file.starts_with("postgresql://") || file.starts_with("postgres://")) {
    return fail("This version keeps catalogues in SQLite files only; " + file + " names a PostgreSQL server.",
                "Give the name of a file, e.g. --database catalogue.sqlite.");
  }
  // SQLite would keep it in memory and lose it at the end.
  if (file == ":memory:") {
    return fail(
        "':memory:' is no file: what it holds would be lost at the end.",
        "Give the name of a file, e.g. --database catalogue.sqlite; for a file of this name ./:memory:.");
  }
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    return fail(file + " is a folder, not a database.", "Give the name of a file in it.");
  }
  const fs::path parent = fs::absolute(file, ignored).parent_path();
  if (!fs::is_directory(parent, ignored)) {
    return fail("The folder " + parent.string() + " for the database does not exist.",
                "Create it, or check the name.");
  }
  if (::access(parent.c_str(), W_OK | X_OK) != 0) {
    return fail(
        "You may not write in " + parent.string() + ", where the database " + file + " keeps its journal.",
        "Change the folder's permissions, or use a copy elsewhere.");
  }
  return fs::exists(file, ignored) ? checkExisting(file) : Result<void>();
}

/// Checks a file that is only read.
Result<void> checkReadable(const std::string& file) {
  if (file.empty()) return fail("No database was named.", "Give the name of a file.");
  std::error_code failure;
  const fs::file_type type = fs::status(file, failure).type();
  if (type == fs::file_type::not_found) return fail("There is no database " + file + ".", "Check the name.");
  if (failure) return fail("Cannot read " + file + " (" + failure.message() + ").", "Check the name.");
  if (type == fs::file_type::directory)
    return fail(file + " is a folder, not a database.", "Give the name of a file in it.");
  if (type != fs::file_type::regular)
    return fail(file + " is not a regular file.", "Give the name of a database file.");
  if (::access(file.c_str(), R_OK) != 0)
    return fail("You may not read the database " + file + ".", "Change its permissions, or use a copy.");
  const std::uintmax_t size = fs::file_size(file, failure);
  if (size > 0 && size < kSmallestDatabase) return fail(notADatabase(file));
  return {};
}

}  // namespace

Error damagedDatabase(const std::string& file, const std::string& detail) {
  return {"The database " + file + " is damaged (" + detail + ").",
          "Restore it from a backup, or try to rescue it with: sqlite3 FILE .recover"};
}

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::open(const std::string& file) {
  SCANTROVE_TRY(checkPath(file));
  auto connection = connect(file, QString::fromStdString(file), {});
  if (!connection) return connection;
  for (const char* pragma : {"PRAGMA synchronous = NORMAL", "PRAGMA foreign_keys = ON"}) {
    SCANTROVE_TRY((*connection)->execute(pragma));
  }
  return connection;
}

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::openToRead(const std::string& file) {
  SCANTROVE_TRY(checkReadable(file));
  const std::optional<Stamp> stamp = stampOf(file);
  // Escapes bytes that have a meaning in a URI.
  const QByteArray path = QByteArray::fromStdString(fs::absolute(file).string()).toPercentEncoding("/");
  const QString uri = "file:" + QString::fromLatin1(path) + "?mode=ro" + (stamp ? "&immutable=1" : "");
  auto connection = connect(file, uri, ";QSQLITE_OPEN_READONLY;QSQLITE_OPEN_URI");
  if (connection) (*connection)->stamp_ = stamp;
  return connection;
}

std::optional<DatabaseConnection::Stamp> DatabaseConnection::stampOf(const std::string& file) {
  struct stat status {};
  // Nobody uses a WAL-mode file without its log.
  for (const char* log : {"-wal", "-journal"}) {
    if (::stat((file + log).c_str(), &status) == 0 && status.st_size > 0) return std::nullopt;
  }
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return Stamp{status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino};
}

bool DatabaseConnection::isStill() const { return !stamp_ || stampOf(file_) == stamp_; }

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::connect(const std::string& file,
                                                                        const QString& name_of_file,
                                                                        const QString& options) {
  static std::atomic<unsigned> serial = 0;
  std::unique_ptr<DatabaseConnection> connection(new DatabaseConnection);
  connection->file_ = file;
  connection->name_ = QString("scantrove-%1").arg(++serial);
  connection->thread_ = std::this_thread::get_id();
  QSqlDatabase database = QSqlDatabase::addDatabase("QSQLITE", connection->name_);
  if (!database.isValid()) {
    return fail("QtSql's SQLite driver is missing.", "Install the package libqt6sql6-sqlite.");
  }
  database.setDatabaseName(name_of_file);
  database.setConnectOptions(QString("QSQLITE_BUSY_TIMEOUT=%1").arg(kBusyTimeout_ms) + options);
  if (!database.open()) return fail(describe(file, database.lastError()));
  return connection;
}

DatabaseConnection::~DatabaseConnection() { QSqlDatabase::removeDatabase(name_); }

Result<void> DatabaseConnection::useWriteAheadLog() {
  // SQLite's busy timeout does not apply to the change to WAL, so wait here.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kBusyTimeout_ms);
  for (;;) {
    const Result<QSqlQuery> wal = execute("PRAGMA journal_mode = WAL");
    if (wal) return {};
    if (wal.error().what.find("locked") == std::string::npos || std::chrono::steady_clock::now() > deadline) {
      return fail(wal.error());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

Result<QSqlQuery> DatabaseConnection::execute(const QString& sql, const QVariantList& values) {
  SCANTROVE_CHECK(thread_ == std::this_thread::get_id());
  if (has_lost_transaction_) {
    return fail("The database " + file_ + " has taken back what was being written into it.",
                "An earlier message names the reason; nothing was changed.");
  }
  QSqlQuery query(QSqlDatabase::database(name_, false));
  query.setForwardOnly(true);
  if (!query.prepare(sql)) return fail(describe(file_, query.lastError()));
  for (const QVariant& value : values) query.addBindValue(value);
  if (!query.exec()) return fail(describe(file_, query.lastError()));
  return query;
}

Result<std::int64_t> DatabaseConnection::insert(const QString& sql, const QVariantList& values) {
  const Result<QSqlQuery> query = execute(sql, values);
  if (!query) return fail(query.error());
  return query->lastInsertId().toLongLong();
}

QString DatabaseConnection::now() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs); }

}  // namespace scantrove
