#include "core/capture/containers/rosbag2_database.h"

#include <spdlog/spdlog.h>
#include <sqlite3.h>

#include <algorithm>
#include <unordered_map>

#include "core/base/regular_file.h"
#include "core/capture/containers/decompression.h"

namespace scantrove {

namespace {

constexpr std::string_view kSqliteMagic = "SQLite format 3";
constexpr int kLongestValue = 96 << 20;

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

/// A URI of the path; special characters as their codes. `immutable`: without looking for a journal, because
/// that of another program's would be created beside the file.
std::string sqliteUri(const std::filesystem::path& path) {
  std::error_code error;
  const std::string name = std::filesystem::absolute(path, error).string();
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char character : name) {
    const auto code = static_cast<unsigned char>(character);
    if (character == '%' || character == '?' || character == '#') {
      uri += {'%', kDigits[code / 16], kDigits[code % 16]};
    } else {
      uri += character;
    }
  }
  const std::filesystem::path journal = path.string() + "-wal";
  const bool has_journal =
      std::filesystem::exists(journal, error) && std::filesystem::file_size(journal, error) > 0;
  return uri + (has_journal ? "?mode=ro" : "?mode=ro&immutable=1");
}

class Rosbag2Database final : public MessageFile {
 public:
  explicit Rosbag2Database(const std::filesystem::path& path) : MessageFile(path) {}

  [[nodiscard]] Result<void> open() {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(sqliteUri(path()).c_str(), &opened,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) return broken();
    // The file may be made by an attacker.
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kLongestValue);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    for (const char* pragma : {"PRAGMA cell_size_check=ON", "PRAGMA cache_size=-16000", "PRAGMA mmap_size=0"})
      sqlite3_exec(opened, pragma, nullptr, nullptr, nullptr);
    return {};
  }

  [[nodiscard]] Result<void> readIndex(OpeningProgress& progress) {
    SCANTROVE_TRY(checkTables());
    SCANTROVE_TRY(readTopics());
    SCANTROVE_TRY(readMessages(progress));
    finishIndex();
    if (topics().empty()) {
      return fail("The database " + path().string() + " holds no message.", "Record or copy it again.");
    }
    return {};
  }

  [[nodiscard]] Result<ByteBlock> read(const MessageEntry& entry, std::size_t limit) override {
    // A compressed message is read as a whole, because its compressed size is unknown.
    constexpr std::size_t kFirst = 4;
    if (limit != kWholeMessage) {
      const Result<ByteBlock> first = readBlob(entry, std::max(limit, kFirst));
      if (!first || !isZstd(*first)) return first;
    }
    Result<ByteBlock> bytes = readBlob(entry, static_cast<std::size_t>(kLongestValue));
    if (!bytes || !isZstd(*bytes)) return bytes;
    Result<ByteBlock> message = decompressZstdStart(*bytes, limit);
    if (!message)
      return fail("The database " + path().string() + " is damaged: " + message.error().what + ".");
    return message;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> broken() const {
    const std::string reason = database_ ? sqlite3_errmsg(database_.get()) : "out of memory";
    return fail("Cannot read the database " + path().string() + ": " + reason + ".",
                "Copy or record it again; close the program that records it.");
  }

  [[nodiscard]] Statement prepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
    return {statement, &sqlite3_finalize};
  }

  /// The tables, and not views, which may compute without end.
  Result<void> checkTables() const {
    const Statement statement = prepare(
        "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('topics', 'messages') AND "
        "sql LIKE 'CREATE TABLE%' AND sql NOT LIKE '%GENERATED%' AND sql NOT LIKE '% AS (%'");
    if (!statement || sqlite3_step(statement.get()) != SQLITE_ROW) return broken();
    if (sqlite3_column_int(statement.get(), 0) == 2) return {};
    return fail(path().string() + " is a SQLite database, but no recording of ROS 2 (rosbag2).",
                "Give the .db3 file of a rosbag2 recording.");
  }

  Result<void> readTopics() {
    const Statement statement =
        prepare("SELECT id, name, type, serialization_format FROM topics LIMIT 10001");
    if (!statement) return broken();
    int code = sqlite3_step(statement.get());
    for (; code == SQLITE_ROW; code = sqlite3_step(statement.get())) {
      const auto text = [&](int column) {
        const auto* const value = reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), column));
        return value == nullptr
                   ? std::string_view()
                   : std::string_view(
                         value, static_cast<std::size_t>(sqlite3_column_bytes(statement.get(), column)));
      };
      const MessageEncoding encoding = text(3) == "cdr" ? MessageEncoding::cdr : MessageEncoding::other;
      const auto topic = topicAt(text(1), text(2), encoding);
      if (!topic) return fail(topic.error());
      numbers_[sqlite3_column_int64(statement.get(), 0)] = *topic;
    }
    return code == SQLITE_DONE ? Result<void>() : broken();
  }

  Result<void> readMessages(OpeningProgress& progress) {
    // In the order of the rows, because that of the times would read every page twice.
    const Statement last = prepare("SELECT max(rowid) FROM messages");
    const double count =
        last && sqlite3_step(last.get()) == SQLITE_ROW ? sqlite3_column_double(last.get(), 0) : 0;
    const Statement statement = prepare("SELECT rowid, topic_id, timestamp FROM messages");
    if (!statement) return broken();
    int code = sqlite3_step(statement.get());
    double row = 0;
    for (; code == SQLITE_ROW; code = sqlite3_step(statement.get())) {
      SCANTROVE_TRY(progress.report(count > 0 ? std::min(1.0, ++row / count) : 0));
      const auto topic = numbers_.find(sqlite3_column_int64(statement.get(), 1));
      if (topic == numbers_.end()) continue;
      const auto number = static_cast<std::uint64_t>(sqlite3_column_int64(statement.get(), 0));
      SCANTROVE_TRY(addMessage(topic->second, {sqlite3_column_int64(statement.get(), 2), number, 0}));
    }
    if (code == SQLITE_DONE) return {};
    if (messageCount() == 0) return broken();
    spdlog::warn("{} is damaged ({}); reading the {} messages before.", path().string(),
                 sqlite3_errmsg(database_.get()), messageCount());
    return {};
  }

  /// Only the pages that hold the first `limit` bytes are read.
  Result<ByteBlock> readBlob(const MessageEntry& entry, std::size_t limit) {
    sqlite3_blob* opened = nullptr;
    int code = sqlite3_blob_open(database_.get(), "main", "messages", "data",
                                 static_cast<sqlite3_int64>(entry.place), 0, &opened);
    const std::unique_ptr<sqlite3_blob, decltype(&sqlite3_blob_close)> blob(opened, &sqlite3_blob_close);
    ByteBlock bytes;
    if (code == SQLITE_OK && sqlite3_blob_bytes(opened) <= kLongestValue) {
      const auto size = static_cast<std::size_t>(sqlite3_blob_bytes(opened));
      bytes.resize(std::min(size, limit));
      code = sqlite3_blob_read(opened, bytes.data(), static_cast<int>(bytes.size()), 0);
      if (code == SQLITE_OK) return bytes;
    }
    return fail("Cannot read a message of " + path().string() + ": " + sqlite3_errmsg(database_.get()) + ".",
                "Copy or record it again.");
  }

  Database database_{nullptr, &sqlite3_close};
  std::unordered_map<sqlite3_int64, std::size_t> numbers_;  // of topics -> their positions
};

}  // namespace

bool isSqlite(ByteView start) {
  return std::string_view(reinterpret_cast<const char*>(start.data()), start.size())
      .starts_with(kSqliteMagic);
}

Result<std::unique_ptr<MessageFile>> openRosbag2Database(const std::filesystem::path& path,
                                                         OpeningProgress& progress) {
  SCANTROVE_TRY(checkRegularFile(path));
  auto database = std::make_unique<Rosbag2Database>(path);
  SCANTROVE_TRY(database->open());
  SCANTROVE_TRY(database->readIndex(progress));
  return database;
}

}  // namespace scantrove
