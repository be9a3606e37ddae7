#include "core/capture/containers/ros_bag.h"

#include <spdlog/spdlog.h>

#include <optional>
#include <unordered_map>

#include "core/capture/containers/chunk_cache.h"

namespace scantrove {

namespace {

// Bag format 2.0 (http://wiki.ros.org/Bags/Format/2.0): records of a header of NAME=VALUE fields and data.
constexpr std::string_view kBagMagic = "#ROSBAG V";
constexpr std::string_view kBagVersion = "#ROSBAG V2.0\n";
constexpr std::uint8_t kBagMessage = 2, kBagHeader = 3, kBagIndex = 4, kBagChunk = 5, kBagConnection = 7;
constexpr std::uint64_t kLargestHeader = 1 << 20;
constexpr std::uint64_t kLargestConnection = 4 << 20;  // with the text of the message's definition
constexpr std::uint64_t kLargestIndex = 64 << 20;
constexpr std::int64_t kNanoseconds = 1'000'000'000;

/// Fields of a record's header. Views point into the bytes.
class BagFields {
 public:
  explicit BagFields(ByteView bytes) {
    ByteCursor cursor(bytes);
    while (cursor.left() > 0) {
      const auto length = cursor.get<std::uint32_t>();
      const std::string_view field = cursor.takeText(length);
      const std::size_t equal = field.find('=');
      if (!cursor.isOk() || equal == std::string_view::npos) return;
      fields_.emplace_back(field.substr(0, equal), field.substr(equal + 1));
    }
    is_ok_ = true;
  }

  [[nodiscard]] bool isOk() const { return is_ok_; }
  [[nodiscard]] std::string_view text(std::string_view name) const {
    for (const auto& [key, value] : fields_)
      if (key == name) return value;
    return {};
  }
  /// Empty: missing, or of another size.
  template <class Number>
  [[nodiscard]] std::optional<Number> number(std::string_view name) const {
    const std::string_view value = text(name);
    if (value.size() != sizeof(Number)) return std::nullopt;
    return ByteCursor({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()}).get<Number>();
  }

 private:
  std::vector<std::pair<std::string_view, std::string_view>> fields_;
  bool is_ok_ = false;
};

std::int64_t bagTime(std::uint32_t seconds, std::uint32_t nanoseconds) {
  return static_cast<std::int64_t>(seconds) * kNanoseconds + nanoseconds;
}

/// A record at the top level.
struct BagRecord {
  ByteBlock header;
  std::uint8_t op = 0;
  std::uint64_t data = 0;  ///< where its data lie in the file
  std::uint64_t data_bytes = 0;
};

class RosBag final : public MessageFile {
 public:
  explicit RosBag(RandomAccessFile file) : MessageFile(file.path()), file_(std::move(file)) {}

  [[nodiscard]] Result<void> readIndex(OpeningProgress& progress) {
    SCANTROVE_TRY(readStart());
    SCANTROVE_TRY(readConnectionsAtEnd());
    std::uint64_t at = kBagVersion.size();
    while (at < file_.size()) {
      SCANTROVE_TRY(progress.report(static_cast<double>(at) / static_cast<double>(file_.size())));
      const Result<std::optional<BagRecord>> record = recordAt(at);
      if (!record) return fail(record.error());
      if (!*record) {
        is_cut_ = true;
        break;
      }
      SCANTROVE_TRY(readRecord(**record));
      at = (*record)->data + (*record)->data_bytes;
    }
    finishIndex();
    if (is_cut_)
      spdlog::warn("{} is not complete; reading the {} messages before its end.", path().string(),
                   messageCount());
    if (topics().empty()) {
      return fail("The bag " + path().string() + " holds no complete message.", "Record or copy it again.");
    }
    return {};
  }

  [[nodiscard]] Result<ByteBlock> read(const MessageEntry& entry, std::size_t limit) override {
    const auto chunk = chunks_cache_.load(file_, chunks_.at(static_cast<std::size_t>(entry.place)));
    if (!chunk) return fail(chunk.error());
    ByteCursor cursor(**chunk);
    cursor.skip(entry.offset);
    const BagFields fields(cursor.take(cursor.get<std::uint32_t>()));
    const auto op = fields.number<std::uint8_t>("op");
    const auto bytes = cursor.get<std::uint32_t>();
    if (!cursor.isOk() || !fields.isOk() || op != kBagMessage || bytes > cursor.left())
      return damaged("a message lies beyond its chunk");
    const ByteView data = cursor.take(std::min<std::size_t>(bytes, limit));
    return ByteBlock(data.begin(), data.end());
  }

 private:
  [[nodiscard]] tl::unexpected<Error> damaged(const std::string& why) const {
    return fail("The bag " + path().string() + " is damaged: " + why + ".", "Copy or record it again.");
  }

  Result<void> readStart() {
    const Result<ByteView> start = file_.peek(0, kBagVersion.size());
    if (!start) return fail(start.error());
    const std::string_view text(reinterpret_cast<const char*>(start->data()), start->size());
    if (text != kBagVersion) {
      return fail(path().string() + " is a ROS bag of a version other than 2.0.",
                  "Convert it with `rosbag fix`, or record it again.");
    }
    const Result<std::optional<BagRecord>> header = recordAt(kBagVersion.size());
    if (!header) return fail(header.error());
    if (!*header || (*header)->op != kBagHeader) return damaged("it has no header");
    const BagFields fields((*header)->header);
    if (!fields.text("encryptor").empty()) {
      return fail("The bag " + path().string() + " is encrypted.", "Decrypt it with `rosbag decrypt`.");
    }
    index_ = fields.number<std::uint64_t>("index_pos").value_or(0);
    return {};
  }

  /// Connections stand again behind the chunks of a complete bag.
  Result<void> readConnectionsAtEnd() {
    if (index_ == 0 || index_ >= file_.size()) {
      is_cut_ = true;
      return {};
    }
    for (std::uint64_t at = index_; at < file_.size();) {
      const Result<std::optional<BagRecord>> record = recordAt(at);
      if (!record || !*record || (*record)->op != kBagConnection) break;  // those in the chunks are read then
      SCANTROVE_TRY(readRecord(**record));
      at = (*record)->data + (*record)->data_bytes;
    }
    return {};
  }

  /// Empty: the file ends before the record's end.
  Result<std::optional<BagRecord>> recordAt(std::uint64_t at) {
    constexpr std::size_t kSize = sizeof(std::uint32_t);
    BagRecord record;
    const auto sizeAt = [&](std::uint64_t place) -> Result<std::optional<std::uint32_t>> {
      const Result<ByteView> bytes = file_.peek(place, kSize);
      if (!bytes) return fail(bytes.error());
      if (bytes->size() < kSize) return std::optional<std::uint32_t>();
      return std::optional(ByteCursor(*bytes).get<std::uint32_t>());
    };
    const auto header_bytes = sizeAt(at);
    if (!header_bytes) return fail(header_bytes.error());
    const std::uint64_t header = at + kSize;
    if (!*header_bytes || header > file_.size() || **header_bytes > file_.size() - header)
      return std::optional<BagRecord>();
    if (**header_bytes > kLargestHeader) return damaged("a record's header is too large");
    SCANTROVE_TRY(moveInto(record.header, readSmall(header, **header_bytes)));
    const auto data_bytes = sizeAt(header + **header_bytes);
    if (!data_bytes) return fail(data_bytes.error());
    record.data = header + **header_bytes + kSize;
    if (!*data_bytes || **data_bytes > file_.size() - record.data) return std::optional<BagRecord>();
    record.data_bytes = **data_bytes;
    const BagFields fields(record.header);
    if (!fields.isOk()) return damaged("a record's header has no fields");
    record.op = fields.number<std::uint8_t>("op").value_or(0);
    return std::optional(std::move(record));
  }

  /// Through the window, if it is small.
  Result<ByteBlock> readSmall(std::uint64_t at, std::uint64_t count) {
    constexpr std::uint64_t kSmall = 4096;
    if (count > kSmall) return file_.read(at, count);
    return file_.peek(at, static_cast<std::size_t>(count)).map([](ByteView bytes) {
      return ByteBlock(bytes.begin(), bytes.end());
    });
  }

  Result<void> readRecord(const BagRecord& record) {
    const BagFields fields(record.header);
    switch (record.op) {
      case kBagChunk:
        return addChunk(record, fields);
      case kBagIndex:
        return addIndex(record, fields);
      case kBagConnection: {
        if (record.data_bytes > kLargestConnection) return damaged("a connection is too large");
        const Result<ByteBlock> data = readSmall(record.data, record.data_bytes);
        if (!data) return fail(data.error());
        return addConnection(fields, BagFields(*data));
      }
      default:  // the header, descriptions of chunks, and what later versions add
        return {};
    }
  }

  Result<void> addChunk(const BagRecord& record, const BagFields& fields) {
    const Result<Compression> compression = compressionNamed(fields.text("compression"));
    if (!compression) return damaged(compression.error().what);
    const auto size = fields.number<std::uint32_t>("size");
    if (!size) return damaged("a chunk has no size");
    chunks_.push_back({record.data, record.data_bytes, *size, *compression});
    are_connections_known_ = false;
    return {};
  }

  Result<void> addConnection(const BagFields& fields, const BagFields& data) {
    const auto number = fields.number<std::uint32_t>("conn");
    if (!number || !data.isOk()) return damaged("a connection has no number");
    if (connections_.contains(*number)) return {};
    const auto topic = topicAt(fields.text("topic"), data.text("type"), MessageEncoding::ros1);
    if (!topic) return fail(topic.error());
    connections_.emplace(*number, *topic);
    return {};
  }

  /// The times and places of a connection's messages in the last chunk.
  Result<void> addIndex(const BagRecord& record, const BagFields& fields) {
    constexpr std::size_t kEntryBytes = 12;
    const auto number = fields.number<std::uint32_t>("conn");
    const auto count = fields.number<std::uint32_t>("count");
    if (fields.number<std::uint32_t>("ver") != 1U || !number || !count || chunks_.empty() ||
        record.data_bytes > kLargestIndex || record.data_bytes != std::uint64_t{*count} * kEntryBytes)
      return damaged("the index of a chunk is wrong");
    auto connection = connections_.find(*number);
    if (connection == connections_.end() && !are_connections_known_) {
      SCANTROVE_TRY(learnConnections());
      connection = connections_.find(*number);
    }
    if (connection == connections_.end()) return {};
    const Result<ByteBlock> data = readSmall(record.data, record.data_bytes);
    if (!data) return fail(data.error());
    ByteCursor cursor(*data);
    while (cursor.left() > 0) {
      const auto seconds = cursor.get<std::uint32_t>();
      const auto nanoseconds = cursor.get<std::uint32_t>();
      const auto offset = cursor.get<std::uint32_t>();
      SCANTROVE_TRY(
          addMessage(connection->second, {bagTime(seconds, nanoseconds), chunks_.size() - 1, offset}));
    }
    return {};
  }

  /// Reads the connections inside the last chunk: all that an incomplete bag has.
  Result<void> learnConnections() {
    are_connections_known_ = true;
    const auto chunk = chunks_cache_.load(file_, chunks_.back());
    if (!chunk) return fail(chunk.error());
    ByteCursor cursor(**chunk);
    while (cursor.left() > 0) {
      const BagFields fields(cursor.take(cursor.get<std::uint32_t>()));
      const ByteView data = cursor.take(cursor.get<std::uint32_t>());
      if (!cursor.isOk() || !fields.isOk()) return damaged("a chunk has no records");
      if (fields.number<std::uint8_t>("op") == kBagConnection)
        SCANTROVE_TRY(addConnection(fields, BagFields(data)));
    }
    return {};
  }

  RandomAccessFile file_;
  std::vector<FileChunk> chunks_;
  ChunkCache chunks_cache_;
  std::unordered_map<std::uint32_t, std::size_t> connections_;  // number -> position of the topic
  std::uint64_t index_ = 0;                                     // where the final index begins; 0: none
  bool is_cut_ = false;
  bool are_connections_known_ = false;  // those of the last chunk
};

}  // namespace

bool isRosBag(ByteView start) {
  return std::string_view(reinterpret_cast<const char*>(start.data()), start.size()).starts_with(kBagMagic);
}

Result<std::unique_ptr<MessageFile>> openRosBag(const std::filesystem::path& path,
                                                OpeningProgress& progress) {
  Result<RandomAccessFile> file = RandomAccessFile::open(path);
  if (!file) return fail(file.error());
  auto bag = std::make_unique<RosBag>(std::move(*file));
  SCANTROVE_TRY(bag->readIndex(progress));
  return bag;
}

}  // namespace scantrove
