#pragma once
#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/oni_bytes.h"

namespace scantrove::test {

/// A message for one of the containers below.
struct ContainerMessage {
  std::string topic;
  std::string type;  ///< "sensor_msgs/Image"; containers of ROS 2 write "sensor_msgs/msg/Image"
  std::int64_t time_ns = 0;
  std::string data;
};
using ContainerMessages = std::vector<ContainerMessage>;

inline std::string compressedBy(const std::string& compression, const std::string& bytes) {
  std::string out;
  if (compression == "lz4") {
    out.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  } else if (compression == "zstd") {
    out.resize(ZSTD_compressBound(bytes.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  } else if (compression == "bz2") {
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 100 + 600);
    out.resize(size);
    BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(bytes.data()),
                             static_cast<unsigned>(bytes.size()), 9, 0, 0);
    out.resize(size);
  } else {
    out = bytes;
  }
  return out;
}

inline std::string sized(const std::string& bytes) {
  return raw(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

/// Topics in the order of their first message.
inline std::vector<const ContainerMessage*> topicsOf(const ContainerMessages& messages) {
  std::vector<const ContainerMessage*> topics;
  for (const ContainerMessage& message : messages) {
    const bool is_known =
        std::ranges::any_of(topics, [&](const auto* one) { return one->topic == message.topic; });
    if (!is_known) topics.push_back(&message);
  }
  return topics;
}

inline std::size_t topicNumber(const ContainerMessages& messages, const std::string& topic) {
  const auto topics = topicsOf(messages);
  return static_cast<std::size_t>(
      std::ranges::find(topics, topic, [](const auto* one) { return one->topic; }) - topics.begin());
}

/// The range of messages of each chunk.
inline std::vector<ContainerMessages> inChunks(const ContainerMessages& messages, std::size_t count) {
  std::vector<ContainerMessages> chunks;
  for (std::size_t at = 0; at < messages.size(); at += count) {
    const auto first = messages.begin() + static_cast<std::ptrdiff_t>(at);
    chunks.emplace_back(first, first + static_cast<std::ptrdiff_t>(std::min(count, messages.size() - at)));
  }
  return chunks;
}

inline std::string bagField(const std::string& name, const std::string& value) {
  return sized(name + "=" + value);
}

inline std::string bagRecord(char op, const std::string& fields, const std::string& data) {
  return sized(bagField("op", std::string(1, op)) + fields) + sized(data);
}

/// A ROS 1 bag (http://wiki.ros.org/Bags/Format/2.0) of chunks with `per_chunk` messages. `is_complete`:
/// false for one whose recorder was killed, without the index at its end.
inline std::string bagBytes(const ContainerMessages& messages, const std::string& compression = "none",
                            std::size_t per_chunk = 4, bool is_complete = true) {
  constexpr std::size_t kHeaderBytes = 4096;
  const auto bagTime = [](std::int64_t time) {
    return raw(static_cast<std::uint32_t>(time / 1'000'000'000)) +
           raw(static_cast<std::uint32_t>(time % 1'000'000'000));
  };
  const auto numberOf = [&](const std::string& topic) {
    return static_cast<std::uint32_t>(topicNumber(messages, topic));
  };
  const auto connection = [&](const ContainerMessage& message) {
    return bagRecord(7, bagField("conn", raw(numberOf(message.topic))) + bagField("topic", message.topic),
                     bagField("topic", message.topic) + bagField("type", message.type) +
                         bagField("md5sum", "*") + bagField("message_definition", ""));
  };
  std::string chunks;
  const auto parts = inChunks(messages, per_chunk);
  for (const ContainerMessages& part : parts) {
    std::string content;
    std::vector<std::string> entries(topicsOf(messages).size());
    for (const ContainerMessage* topic : topicsOf(part)) content += connection(*topic);
    for (const ContainerMessage& message : part) {
      const std::uint32_t number = numberOf(message.topic);
      entries[number] += bagTime(message.time_ns) + raw(static_cast<std::uint32_t>(content.size()));
      content += bagRecord(2, bagField("conn", raw(number)) + bagField("time", bagTime(message.time_ns)),
                           message.data);
    }
    chunks += bagRecord(5,
                        bagField("compression", compression) +
                            bagField("size", raw(static_cast<std::uint32_t>(content.size()))),
                        compressedBy(compression, content));
    for (std::uint32_t number = 0; number < entries.size(); ++number) {
      if (entries[number].empty()) continue;
      chunks += bagRecord(4,
                          bagField("ver", raw(std::uint32_t{1})) + bagField("conn", raw(number)) +
                              bagField("count", raw(static_cast<std::uint32_t>(entries[number].size() / 12))),
                          entries[number]);
    }
  }
  const std::string magic = "#ROSBAG V2.0\n";
  const std::uint64_t index = is_complete ? magic.size() + kHeaderBytes + chunks.size() : 0;
  const std::string fields =
      bagField("index_pos", raw(index)) +
      bagField("conn_count", raw(static_cast<std::uint32_t>(topicsOf(messages).size()))) +
      bagField("chunk_count", raw(static_cast<std::uint32_t>(parts.size())));
  const std::size_t used = bagRecord(3, fields, "").size();
  std::string bag = magic + bagRecord(3, fields, std::string(kHeaderBytes - used, ' ')) + chunks;
  if (!is_complete) return bag;
  for (const ContainerMessage* topic : topicsOf(messages)) bag += connection(*topic);
  return bag;
}

/// "sensor_msgs/Image" -> "sensor_msgs/msg/Image"
inline std::string ros2Type(std::string type) {
  const std::size_t slash = type.find('/');
  return slash == std::string::npos ? type : type.insert(slash, "/msg");
}

/// Layout of an MCAP file.
struct McapLayout {
  std::string compression = "";
  std::size_t per_chunk = 4;  ///< 0: without chunks
  bool has_index = true;
  bool is_complete = true;  ///< false: without summary and footer
  std::string encoding = "cdr";
};

inline std::string mcapRecord(char op, const std::string& content) {
  return std::string(1, op) + raw(static_cast<std::uint64_t>(content.size())) + content;
}

/// An MCAP file (https://mcap.dev/spec).
inline std::string mcapBytes(const ContainerMessages& messages, const McapLayout& layout = {}) {
  const std::string magic = "\x89MCAP0\r\n";
  std::string definitions;
  for (const ContainerMessage* topic : topicsOf(messages)) {
    const auto number = static_cast<std::uint16_t>(topicNumber(messages, topic->topic) + 1);
    const std::string type = layout.encoding == "cdr" ? ros2Type(topic->type) : topic->type;
    definitions += mcapRecord(3, raw(number) + sized(type) + sized("ros2msg") + sized(""));
    definitions +=
        mcapRecord(4, raw(number) + raw(number) + sized(topic->topic) + sized(layout.encoding) + sized(""));
  }
  const auto messageRecord = [&](const ContainerMessage& message) {
    const auto number = static_cast<std::uint16_t>(topicNumber(messages, message.topic) + 1);
    return mcapRecord(
        5, raw(number) + raw(std::uint32_t{0}) + raw(message.time_ns) + raw(message.time_ns) + message.data);
  };
  std::string file = magic + mcapRecord(1, sized("ros2") + sized("test"));
  if (layout.per_chunk == 0) {
    file += definitions;
    for (const ContainerMessage& message : messages) file += messageRecord(message);
  } else {
    for (const ContainerMessages& part : inChunks(messages, layout.per_chunk)) {
      std::string content = definitions;
      std::vector<std::string> entries(topicsOf(messages).size());
      for (const ContainerMessage& message : part) {
        std::string& entry = entries[topicNumber(messages, message.topic)];
        entry += raw(message.time_ns);
        entry += raw(static_cast<std::uint64_t>(content.size()));
        content += messageRecord(message);
      }
      const std::string stored = compressedBy(layout.compression, content);
      file += mcapRecord(6, raw(part.front().time_ns) + raw(part.back().time_ns) +
                                raw(static_cast<std::uint64_t>(content.size())) + raw(std::uint32_t{0}) +
                                sized(layout.compression) + raw(static_cast<std::uint64_t>(stored.size())) +
                                stored);
      for (std::size_t i = 0; i < entries.size() && layout.has_index; ++i)
        if (!entries[i].empty())
          file += mcapRecord(7, raw(static_cast<std::uint16_t>(i + 1)) + sized(entries[i]));
    }
  }
  if (!layout.is_complete) return file;
  file += mcapRecord(15, raw(std::uint32_t{0}));
  const auto summary = static_cast<std::uint64_t>(file.size());
  return file + definitions + mcapRecord(2, raw(summary) + raw(std::uint64_t{0}) + raw(std::uint32_t{0})) +
         magic;
}

/// Writes a database of rosbag2, replacing `path`. `compression`: "" or "zstd", of each message.
inline void writeRosbag2(const std::filesystem::path& path, const ContainerMessages& messages,
                         const std::string& compression = "") {
  std::filesystem::remove(path);
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  const auto run = [&](const char* sql) {
    if (sqlite3_exec(database, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(database));
  };
  run("PRAGMA journal_mode=MEMORY; PRAGMA synchronous=OFF; BEGIN;"
      "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format "
      "TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, "
      "data "
      "BLOB NOT NULL);"
      "CREATE INDEX timestamp_idx ON messages (timestamp ASC);");
  sqlite3_stmt* statement = nullptr;
  const auto text = [&](int at, const std::string& value) {
    sqlite3_bind_text(statement, at, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
  };
  sqlite3_prepare_v2(database, "INSERT INTO topics VALUES(?1,?2,?3,'cdr','')", -1, &statement, nullptr);
  for (const ContainerMessage* topic : topicsOf(messages)) {
    sqlite3_bind_int64(statement, 1, static_cast<sqlite3_int64>(topicNumber(messages, topic->topic) + 1));
    text(2, topic->topic);
    text(3, ros2Type(topic->type));
    sqlite3_step(statement);
    sqlite3_reset(statement);
  }
  sqlite3_finalize(statement);
  sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id,timestamp,data) VALUES(?1,?2,?3)", -1,
                     &statement, nullptr);
  for (const ContainerMessage& message : messages) {
    const std::string data = compressedBy(compression, message.data);
    sqlite3_bind_int64(statement, 1, static_cast<sqlite3_int64>(topicNumber(messages, message.topic) + 1));
    sqlite3_bind_int64(statement, 2, message.time_ns);
    sqlite3_bind_blob(statement, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    sqlite3_step(statement);
    sqlite3_reset(statement);
  }
  sqlite3_finalize(statement);
  run("COMMIT");
  sqlite3_close(database);
}

/// An element of Matroska: an id of any length, a size of eight bytes, data.
inline std::string ebmlElement(std::uint32_t id, const std::string& data) {
  std::string element;
  for (int shift = 24; shift >= 0; shift -= 8)
    if (id >> shift != 0) element += static_cast<char>(id >> shift & 0xFFU);
  element += '\x01';
  for (int shift = 48; shift >= 0; shift -= 8) element += static_cast<char>(data.size() >> shift & 0xFFU);
  return element + data;
}

inline std::string ebmlNumber(std::uint32_t id, std::uint32_t value) {
  std::string data;
  for (int shift = 24; shift >= 0; shift -= 8) data += static_cast<char>(value >> shift & 0xFFU);
  return ebmlElement(id, data);
}

/// A video track of a Matroska file as k4arecorder writes it.
struct MatroskaTestTrack {
  std::string name, four_characters;
  int width = 0, height = 0;
  std::vector<std::pair<std::int64_t, std::string>> images;  ///< time in milliseconds, bytes
};

/// A Matroska file (RFC 9559) with a cluster for each image, and an attachment.
inline std::string matroskaBytes(const std::vector<MatroskaTestTrack>& tracks,
                                 const std::string& calibration) {
  std::string entries, clusters;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const MatroskaTestTrack& track = tracks[i];
    const std::string header = raw(std::uint32_t{40}) + raw(track.width) + raw(track.height) +
                               raw(std::uint16_t{1}) + raw(std::uint16_t{16}) + track.four_characters +
                               std::string(20, '\0');
    const std::string video = ebmlNumber(0xB0, static_cast<std::uint32_t>(track.width)) +
                              ebmlNumber(0xBA, static_cast<std::uint32_t>(track.height));
    entries += ebmlElement(0xAE, ebmlNumber(0xD7, static_cast<std::uint32_t>(i + 1)) + ebmlNumber(0x83, 1) +
                                     ebmlElement(0x536E, track.name) + ebmlElement(0x86, "V_MS/VFW/FOURCC") +
                                     ebmlElement(0x63A2, header) + ebmlElement(0xE0, video));
    for (const auto& [time, bytes] : track.images) {
      const std::string block =
          std::string(1, static_cast<char>(0x81U + i)) + std::string("\0\0\x80", 3) + bytes;
      clusters += ebmlElement(0x1F43B675,
                              ebmlNumber(0xE7, static_cast<std::uint32_t>(time)) + ebmlElement(0xA3, block));
    }
  }
  const std::string attached =
      ebmlElement(0x61A7, ebmlElement(0x466E, "calibration.json") + ebmlElement(0x465C, calibration));
  return ebmlElement(0x1A45DFA3, ebmlElement(0x4282, "matroska")) +
         ebmlElement(0x18538067, ebmlElement(0x1549A966, ebmlNumber(0x2AD7B1, 1'000'000)) +
                                     ebmlElement(0x1654AE6B, entries) + ebmlElement(0x1941A469, attached) +
                                     clusters);
}

}  // namespace scantrove::test
