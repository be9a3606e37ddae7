#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/result.h"
#include "core/capture/containers/byte_cursor.h"

namespace scantrove {

/// Serialisation of a message.
enum class MessageEncoding {
  ros1,   ///< ROS 1: little-endian, without padding
  cdr,    ///< ROS 2: OMG's CDR with its header of four bytes
  other,  ///< protobuf, JSON, ...
};

/// Place of one message in its file.
struct MessageEntry {
  std::int64_t time_ns = 0;  ///< when it was recorded, since the epoch of the file
  std::uint64_t place = 0;   ///< the file's own: a chunk or a row
  std::uint64_t offset = 0;  ///< in the chunk
};

/// A named series of messages of one type.
struct MessageTopic {
  std::string name;
  std::string type;  ///< without "/msg": "sensor_msgs/Image"
  MessageEncoding encoding = MessageEncoding::other;
  std::vector<MessageEntry> messages;  ///< by time; of types without images only the first kFewMessages
};

/// A recording of messages: a ROS 1 bag, a database of rosbag2, an MCAP file. Opening reads its index;
/// messages are read when they are asked for. One thread.
class MessageFile {
 public:
  static constexpr std::size_t kWholeMessage = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t kLongestName = 4096;  ///< of topics and types

  virtual ~MessageFile() = default;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Sorted by name; without those that have no message.
  [[nodiscard]] const std::vector<MessageTopic>& topics() const { return topics_; }
  [[nodiscard]] const MessageTopic* findTopic(std::string_view name) const;

  /// The bytes of a message, at most the first `limit`. Error: names the file; damaged, truncated.
  [[nodiscard]] virtual Result<ByteBlock> read(const MessageEntry& entry,
                                               std::size_t limit = kWholeMessage) = 0;

 protected:
  explicit MessageFile(std::filesystem::path path) : path_(std::move(path)) {}

  /// Adds a topic or returns the position of the one of this name. Positions are valid until finishIndex().
  /// Error: names of more than kLongestName bytes, or too many topics: a small compressed file may hold
  /// gigabytes of them.
  [[nodiscard]] Result<std::size_t> topicAt(std::string_view name, std::string_view type,
                                            MessageEncoding encoding);
  /// Error: more messages than memory is meant for.
  [[nodiscard]] Result<void> addMessage(std::size_t topic, const MessageEntry& entry);
  /// Sorts topics by name and messages by time.
  void finishIndex();
  [[nodiscard]] std::size_t messageCount() const { return count_; }

 private:
  std::filesystem::path path_;
  std::vector<MessageTopic> topics_;
  std::unordered_map<std::string, std::size_t> positions_;  // by name, until finishIndex()
  std::size_t count_ = 0;
};

/// Whether the type is sensor_msgs/Image or sensor_msgs/CompressedImage.
[[nodiscard]] bool isImageType(std::string_view type);

}  // namespace scantrove
