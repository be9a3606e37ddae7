#include "core/database/sqlite_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <QSqlError>
#include <filesystem>
#include <system_error>

#include "core/database/database_connection.h"

namespace scantrove::sqlite {
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

}  // namespace

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

Result<void> checkPath(const std::string& file) {
  if (file.empty()) return fail("No database was named.", "Give the name of a file.");
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

std::optional<Stamp> stampOf(const std::string& file) {
  struct stat status {};
  // Nobody uses a WAL-mode file without its log.
  for (const char* log : {"-wal", "-journal"}) {
    if (::stat((file + log).c_str(), &status) == 0 && status.st_size > 0) return std::nullopt;
  }
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return Stamp{status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino};
}

}  // namespace scantrove::sqlite
