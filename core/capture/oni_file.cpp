#include "core/capture/oni_file.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/base/regular_file.h"

namespace scantrove {

namespace {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in the file");

constexpr std::array<char, 4> kFileMagic = {'N', 'I', '1', '0'};
constexpr std::array<char, 4> kRecordMagic = {'N', 'I', 'R', '\0'};
constexpr std::uint64_t kFileHeaderBytes = 24;  // magic, version, time of the last frame, greatest node

/// Every record begins with it; its fields (which count the header in) and its payload follow.
struct RecordHeader {
  std::array<char, 4> magic;
  std::uint32_t type;
  std::uint32_t node;
  std::uint32_t fields_bytes;
  std::uint32_t payload_bytes;
};
constexpr std::uint32_t kHeaderBytes =
    sizeof(RecordHeader) + sizeof(std::uint64_t);  // and its undo record's place
constexpr std::uint32_t kEndRecord = 0x0B;
constexpr std::uint32_t kLargestRecord = 20U << 20;  // what OpenNI2's own reader has room for

template <class Value>
std::optional<Value> readAt(std::ifstream& stream, std::uint64_t position) {
  Value value;
  stream.seekg(static_cast<std::streamoff>(position));
  if (!stream.read(reinterpret_cast<char*>(&value), sizeof value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

Result<void> checkOniFile(const std::filesystem::path& file) {
  SCANTROVE_TRY(checkRegularFile(file));
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (readAt<std::array<char, 4>>(stream, 0) != kFileMagic) {
    return fail(file.string() + " is no OpenNI2 recording.",
                "Give an .oni file that a recorder has completed.");
  }
  for (std::uint64_t at = kFileHeaderBytes; size >= at + kHeaderBytes;) {
    const auto record = readAt<RecordHeader>(stream, at);
    if (!record || record->magic != kRecordMagic || record->fields_bytes < kHeaderBytes ||
        record->fields_bytes > kLargestRecord || record->payload_bytes > kLargestRecord) {
      return fail(file.string() + " is damaged at byte " + std::to_string(at) + ".",
                  "It cannot be played; record it again.");
    }
    if (record->type == kEndRecord) {
      return {};
    }
    at += std::uint64_t{record->fields_bytes} + record->payload_bytes;
  }
  return fail(file.string() + " is truncated (" + std::to_string(size) + " bytes).",
              "It cannot be played; was the recorder stopped before it had written all?");
}

}  // namespace scantrove
