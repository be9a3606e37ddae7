#include "core/capture/containers/mcap_file.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/capture/containers/chunk_cache.h"

namespace scantrove {

namespace {

// The format is described at https://mcap.dev/spec: records of an opcode, a length and their content.
constexpr std::array<std::uint8_t, 8> kMcapMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
enum class McapOp : std::uint8_t {
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  data_end = 15,
};
constexpr std::size_t kMcapRecordStart = 9;    // opcode, length
constexpr std::size_t kMcapMessageStart = 22;  // channel, sequence, two times
constexpr std::size_t kMcapFooterBytes = 20;
constexpr std::uint64_t kLargestMcapRecord = 64 << 20;  // of those that are read as a whole
constexpr std::uint64_t kNoChunk = ~std::uint64_t{0};   // MessageEntry::place of a message outside of chunks

class McapFile final : public MessageFile {
 public:
  explicit McapFile(RandomAccessFile file) : MessageFile(file.path()), file_(std::move(file)) {}

  [[nodiscard]] Result<void> readIndex(OpeningProgress& progress) {
    SCANTROVE_TRY(readSummary());
    std::uint64_t at = kMcapMagic.size();
    bool is_over = false;
    while (!is_over) {
      SCANTROVE_TRY(progress.report(static_cast<double>(at) / static_cast<double>(file_.size())));
      const Result<ByteView> start = file_.peek(at, kMcapRecordStart);
      if (!start) return fail(start.error());
      ByteCursor cursor(*start);
      const auto op = static_cast<McapOp>(cursor.get<std::uint8_t>());
      const auto bytes = cursor.get<std::uint64_t>();
      at += kMcapRecordStart;
      is_over = op == McapOp::data_end || op == McapOp::footer;
      if (!cursor.isOk() || at > file_.size() || bytes > file_.size() - at) {
        is_cut_ = true;
        break;
      }
      if (op != McapOp::message_index) SCANTROVE_TRY(indexLastChunk());
      SCANTROVE_TRY(readRecord(op, at, bytes));
      at += bytes;
    }
    SCANTROVE_TRY(indexLastChunk());
    finishIndex();
    if (is_cut_)
      spdlog::warn("{} is not complete; reading the {} messages before its end.", path().string(),
                   messageCount());
    if (topics().empty()) {
      return fail("The MCAP file " + path().string() + " holds no complete message.",
                  "Record or copy it again.");
    }
    return {};
  }

  [[nodiscard]] Result<ByteBlock> read(const MessageEntry& entry, std::size_t limit) override {
    if (entry.place == kNoChunk) return readOutside(entry, limit);
    const auto chunk = chunks_cache_.load(file_, chunks_.at(static_cast<std::size_t>(entry.place)));
    if (!chunk) return fail(chunk.error());
    ByteCursor cursor(**chunk);
    cursor.skip(entry.offset);
    const auto op = static_cast<McapOp>(cursor.get<std::uint8_t>());
    const auto bytes = cursor.get<std::uint64_t>();
    if (!cursor.isOk() || op != McapOp::message || bytes < kMcapMessageStart || bytes > cursor.left())
      return damaged("a message lies beyond its chunk");
    cursor.skip(kMcapMessageStart);
    const ByteView data = cursor.take(std::min<std::uint64_t>(bytes - kMcapMessageStart, limit));
    return ByteBlock(data.begin(), data.end());
  }

 private:
  [[nodiscard]] tl::unexpected<Error> damaged(const std::string& why) const {
    return fail("The MCAP file " + path().string() + " is damaged: " + why + ".", "Copy or record it again.");
  }

  /// Schemas and channels stand again in the summary of a complete file.
  Result<void> readSummary() {
    constexpr std::size_t kEnd = kMcapRecordStart + kMcapFooterBytes + kMcapMagic.size();
    if (file_.size() < kMcapMagic.size() + kEnd) return {};
    const Result<ByteBlock> end = file_.read(file_.size() - kEnd, kEnd);
    if (!end) return fail(end.error());
    ByteCursor cursor(*end);
    const auto op = static_cast<McapOp>(cursor.get<std::uint8_t>());
    cursor.skip(sizeof(std::uint64_t));
    const auto summary = cursor.get<std::uint64_t>();
    is_cut_ = op != McapOp::footer || !std::ranges::equal(ByteView(*end).last(kMcapMagic.size()), kMcapMagic);
    const std::uint64_t footer = file_.size() - kEnd;
    if (is_cut_ || summary == 0 || summary >= footer || footer - summary > kLargestMcapRecord) return {};
    const Result<ByteBlock> records = file_.read(summary, footer - summary);
    if (!records) return fail(records.error());
    return readDefinitions(*records);
  }

  Result<void> readRecord(McapOp op, std::uint64_t at, std::uint64_t bytes) {
    switch (op) {
      case McapOp::chunk:
        return addChunk(at, bytes);
      case McapOp::message_index:
        return addMessageIndex(at, bytes);
      case McapOp::message:
        return addMessageOutside(at, bytes);
      case McapOp::schema:
      case McapOp::channel: {
        if (bytes > kLargestMcapRecord) return damaged("a schema or channel is too large");
        const Result<ByteBlock> content = file_.read(at, bytes);
        if (!content) return fail(content.error());
        return define(op, *content);
      }
      default:
        return {};
    }
  }

  Result<void> addChunk(std::uint64_t at, std::uint64_t bytes) {
    constexpr std::size_t kFixed = 3 * sizeof(std::uint64_t) + 2 * sizeof(std::uint32_t);
    constexpr std::size_t kLongestCompressionName = 32;
    const Result<ByteView> start = file_.peek(at, kFixed + kLongestCompressionName + sizeof(std::uint64_t));
    if (!start) return fail(start.error());
    ByteCursor cursor(*start);
    cursor.skip(2 * sizeof(std::uint64_t));
    FileChunk chunk;
    chunk.bytes = cursor.get<std::uint64_t>();
    cursor.skip(sizeof(std::uint32_t));
    const std::string_view name = cursor.takeText(cursor.get<std::uint32_t>());
    chunk.stored_bytes = cursor.get<std::uint64_t>();
    chunk.offset = at + cursor.position();
    if (!cursor.isOk() || cursor.position() > bytes || chunk.stored_bytes > bytes - cursor.position())
      return damaged("a chunk has a wrong size");
    const Result<Compression> compression = compressionNamed(name);
    if (!compression) return damaged(compression.error().what);
    chunk.compression = *compression;
    chunks_.push_back(chunk);
    is_last_chunk_indexed_ = chunk.bytes == 0;
    are_definitions_known_ = false;
    return {};
  }

  Result<void> addMessageIndex(std::uint64_t at, std::uint64_t bytes) {
    if (chunks_.empty() || bytes > kLargestMcapRecord) return damaged("the index of a chunk is wrong");
    is_last_chunk_indexed_ = true;
    const Result<ByteBlock> content = file_.read(at, bytes);
    if (!content) return fail(content.error());
    ByteCursor cursor(*content);
    const auto channel = cursor.get<std::uint16_t>();
    ByteCursor entries(cursor.take(cursor.get<std::uint32_t>()));
    if (!channels_.contains(channel) && !are_definitions_known_) {
      are_definitions_known_ = true;
      const auto chunk = chunks_cache_.load(file_, chunks_.back());
      if (!chunk) return fail(chunk.error());
      SCANTROVE_TRY(readDefinitions(**chunk));
    }
    while (entries.left() > 0) {
      const auto time = entries.get<std::uint64_t>();
      const auto offset = entries.get<std::uint64_t>();
      if (!entries.isOk()) return damaged("the index of a chunk is wrong");
      SCANTROVE_TRY(addTo(channel, {static_cast<std::int64_t>(time), chunks_.size() - 1, offset}));
    }
    return {};
  }

  /// Some writers leave out the index of messages.
  Result<void> indexLastChunk() {
    if (is_last_chunk_indexed_) return {};
    is_last_chunk_indexed_ = true;
    const auto chunk = chunks_cache_.load(file_, chunks_.back());
    if (!chunk) return fail(chunk.error());
    SCANTROVE_TRY(readDefinitions(**chunk));
    ByteCursor cursor(**chunk);
    while (cursor.left() > 0) {
      const std::size_t offset = cursor.position();
      const auto op = static_cast<McapOp>(cursor.get<std::uint8_t>());
      ByteCursor content(cursor.take(cursor.get<std::uint64_t>()));
      if (!cursor.isOk()) return damaged("a chunk has no records");
      if (op != McapOp::message) continue;
      const auto channel = content.get<std::uint16_t>();
      content.skip(sizeof(std::uint32_t));
      const auto time = static_cast<std::int64_t>(content.get<std::uint64_t>());
      SCANTROVE_TRY(addTo(channel, {time, chunks_.size() - 1, offset}));
    }
    return {};
  }

  Result<void> addMessageOutside(std::uint64_t at, std::uint64_t bytes) {
    const Result<ByteView> start = file_.peek(at, kMcapMessageStart);
    if (!start) return fail(start.error());
    ByteCursor cursor(*start);
    const auto channel = cursor.get<std::uint16_t>();
    cursor.skip(sizeof(std::uint32_t));
    const auto time = static_cast<std::int64_t>(cursor.get<std::uint64_t>());
    if (!cursor.isOk() || bytes < kMcapMessageStart) return damaged("a message is too short");
    return addTo(channel, {time, kNoChunk, at - kMcapRecordStart});
  }

  Result<ByteBlock> readOutside(const MessageEntry& entry, std::size_t limit) {
    const Result<ByteView> start = file_.peek(entry.offset, kMcapRecordStart);
    if (!start) return fail(start.error());
    ByteCursor cursor(*start);
    cursor.skip(1);
    const auto bytes = cursor.get<std::uint64_t>();
    if (!cursor.isOk() || bytes < kMcapMessageStart || bytes > kMaxDecompressedBytes)
      return damaged("a message has a wrong size");
    return file_.read(entry.offset + kMcapRecordStart + kMcapMessageStart,
                      std::min<std::uint64_t>(bytes - kMcapMessageStart, limit));
  }

  Result<void> addTo(std::uint16_t channel, const MessageEntry& entry) {
    const auto found = channels_.find(channel);
    return found == channels_.end() ? Result<void>() : addMessage(found->second, entry);
  }

  /// Reads the schemas and channels among `records`.
  Result<void> readDefinitions(ByteView records) {
    ByteCursor cursor(records);
    while (cursor.left() > 0) {
      const auto op = static_cast<McapOp>(cursor.get<std::uint8_t>());
      const ByteView content = cursor.take(cursor.get<std::uint64_t>());
      if (!cursor.isOk()) return damaged("a record lies beyond its chunk");
      if (op == McapOp::schema || op == McapOp::channel) SCANTROVE_TRY(define(op, content));
    }
    return {};
  }

  Result<void> define(McapOp op, ByteView content) {
    ByteCursor cursor(content);
    const auto number = cursor.get<std::uint16_t>();
    const std::uint16_t schema = op == McapOp::channel ? cursor.get<std::uint16_t>() : std::uint16_t{0};
    const std::string_view name = cursor.takeText(cursor.get<std::uint32_t>());
    const std::string_view encoding = cursor.takeText(cursor.get<std::uint32_t>());
    if (!cursor.isOk()) return damaged("a schema or channel is cut");
    if (op == McapOp::schema) {
      if (name.size() > kLongestName) return damaged("the name of a schema has more than 4096 bytes");
      schemas_[number] = name;
      return {};
    }
    const MessageEncoding known = encoding == "cdr"    ? MessageEncoding::cdr
                                  : encoding == "ros1" ? MessageEncoding::ros1
                                                       : MessageEncoding::other;
    if (channels_.contains(number)) return {};
    const auto topic = topicAt(name, schemas_[schema], known);
    if (!topic) return fail(topic.error());
    channels_[number] = *topic;
    return {};
  }

  RandomAccessFile file_;
  std::vector<FileChunk> chunks_;
  ChunkCache chunks_cache_;
  std::unordered_map<std::uint16_t, std::string> schemas_;
  std::unordered_map<std::uint16_t, std::size_t> channels_;  // -> position of the topic
  bool is_cut_ = true;
  bool is_last_chunk_indexed_ = true;
  bool are_definitions_known_ = true;  // those of the last chunk
};

}  // namespace

bool isMcap(ByteView start) {
  return start.size() >= kMcapMagic.size() && std::ranges::equal(start.first(kMcapMagic.size()), kMcapMagic);
}

Result<std::unique_ptr<MessageFile>> openMcap(const std::filesystem::path& path, OpeningProgress& progress) {
  Result<RandomAccessFile> file = RandomAccessFile::open(path);
  if (!file) return fail(file.error());
  auto mcap = std::make_unique<McapFile>(std::move(*file));
  SCANTROVE_TRY(mcap->readIndex(progress));
  return mcap;
}

}  // namespace scantrove
