#include "core/session/session_database.h"

#include <fcntl.h>
#include <stdio.h>  // renameat2

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/session/session_files.h"
#include "core/session/session_schema.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using Place = HeldFile::Place;

constexpr int kMaxNames = 1000;
/// Suffixes of SQLite's files beside a database.
constexpr std::array kBeside{"-wal", "-shm"};

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() != fs::file_type::not_found;
}

/// `session.rescued.sqlite`, `session.rescued-2.sqlite`, ...: the first free name.
fs::path freeNameBeside(const fs::path& file, const std::string& word) {
  fs::path name;
  for (int i = 1; i <= kMaxNames; ++i) {
    name = file;
    name.replace_filename(file.stem().string() + "." + word + (i > 1 ? "-" + std::to_string(i) : "") +
                          file.extension().string());
    if (!isThere(name)) break;
  }
  return name;
}

Result<void> renameOver(const fs::path& from, const fs::path& to) {
  std::error_code failure;
  fs::rename(from, to, failure);
  if (!failure) return {};
  return fail("The file " + to.string() + " cannot be written: " + failure.message() + ".",
              "Check the folder.");
}

/// Error: another file has the name `to`.
Result<void> renameToFreeName(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return {};
  // Some file systems do not support this kind of renaming.
  if (errno != EINVAL || isThere(to))
    return fail(
        "The file " + to.string() + " cannot be written: " + std::generic_category().message(errno) + ".",
        "Check the folder.");
  return renameOver(from, to);
}

}  // namespace

Result<SessionDatabase> SessionDatabase::open(const fs::path& file) {
  SessionDatabase database(file);
  SCANTROVE_TRY(database.connect());
  return database;
}

Result<void> SessionDatabase::connect() {
  SCANTROVE_TRY(moveInto(connection_, DatabaseConnection::open(file_.string())));
  SCANTROVE_TRY(schema::migrate(*connection_, schema::kSession, schema::sessionSteps()));
  // SQLite opens its files beside the database at the first read.
  SCANTROVE_TRY(connection_->execute("SELECT count(*) FROM facts"));
  main_ = HeldFile::hold(file_);
  beside_.clear();
  for (const char* ending : kBeside) {
    std::optional<HeldFile> held = HeldFile::hold(file_.string() + ending);
    if (!held) main_.reset();
    if (held) beside_.push_back(std::move(*held));
  }
  if (main_) return {};
  return fail("The file " + file_.string() + " was removed while it was opened.", "Put it back.");
}

bool SessionDatabase::isStillThere() const {
  const auto is_same = [](const HeldFile& held) { return held.place() == Place::same; };
  return main_ && is_same(*main_) && std::ranges::all_of(beside_, is_same);
}

fs::path SessionDatabase::folderItWasMovedWith() const {
  if (main_->place() != Place::moved || isThere(file_.parent_path())) return {};
  const fs::path now = main_->nameNow();
  return now.filename() == file_.filename() ? now.parent_path() : fs::path();
}

bool SessionDatabase::isLogTaken() const {
  return std::ranges::any_of(beside_, [](const HeldFile& held) { return held.place() == Place::replaced; });
}

void SessionDatabase::disconnect() {
  // SQLite removes log and index by name when it closes; these may belong to another session by now.
  if (isLogTaken()) {
    static_cast<void>(connection_.release());  // stays open until the program ends
    return;
  }
  connection_.reset();
  // SQLite would replay a remaining log into any file with the database's name.
  for (std::size_t i = 0; i < beside_.size(); ++i) {
    std::error_code ignored;
    if (beside_[i].place() == Place::same) fs::remove(file_.string() + kBeside[i], ignored);
  }
}

Result<void> SessionDatabase::moveTo(const fs::path& folder) {
  disconnect();
  file_ = folder / file_.filename();
  return connect();
}

Result<void> SessionDatabase::writeAnew() {
  const fs::path unfinished = freeNameBeside(file_, "unfinished");
  SCANTROVE_TRY(connection_->execute("VACUUM INTO ?", {QString::fromStdString(unfinished.string())}));
  SCANTROVE_TRY(flushFile(unfinished));
  const bool is_taken = main_->place() == Place::replaced || isLogTaken();
  const fs::path name = is_taken ? freeNameBeside(file_, "rescued") : file_;
  // If only its log or index is missing, the name belongs to our own file.
  const bool is_ours = name == file_ && main_->place() == Place::same;
  disconnect();
  const Result<void> renamed = is_ours ? renameOver(unfinished, name) : renameToFreeName(unfinished, name);
  file_ = renamed ? name : unfinished;
  SCANTROVE_TRY(connect());
  SCANTROVE_TRY(renamed);
  return flushFolder(name.parent_path());
}

}  // namespace scantrove
