#include "core/capture/oni_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "core/base/regular_file.h"

namespace scantrove {

namespace {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in the file");

constexpr std::array<char, 4> kFileMagic = {'N', 'I', '1', '0'};
constexpr std::array<char, 4> kRecordMagic = {'N', 'I', 'R', '\0'};
constexpr std::uint64_t kFileHeaderBytes = 24;  // magic, version, time of the last frame, greatest node

/// Header of every record, followed by its fields (whose size includes the header) and its payload.
struct RecordHeader {
  std::array<char, 4> magic;
  std::uint32_t type;
  std::uint32_t node;
  std::uint32_t fields_bytes;
  std::uint32_t payload_bytes;
};
constexpr std::uint32_t kHeaderBytes =
    sizeof(RecordHeader) + sizeof(std::uint64_t);  // and the offset of its undo record
constexpr std::uint32_t kEndRecord = 0x0B;
constexpr std::uint32_t kLargestRecord = 20U << 20;  // buffer size of OpenNI2's reader

/// Images that cameras take: OpenNI2 allocates several of the size that the file names.
constexpr std::uint32_t kLongestSide_px = 8192, kMostPixels = 32U << 20;

/// Types whose fields begin with a length-prefixed name. Properties continue with the length of a value.
constexpr std::uint32_t kFirstProperty = 0x03;
constexpr std::uint32_t kLastProperty = 0x06;
constexpr std::array<std::uint32_t, 3> kNodeAdded = {0x02, 0x0C, 0x0D};

template <class Value>
std::optional<Value> readAt(std::ifstream& stream, std::uint64_t position) {
  Value value;
  stream.seekg(static_cast<std::streamoff>(position));
  if (!stream.read(reinterpret_cast<char*>(&value), sizeof value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::string> readText(std::ifstream& stream, std::uint64_t position, std::uint32_t size) {
  std::string text(size, '\0');
  stream.seekg(static_cast<std::streamoff>(position));
  if (!stream.read(text.data(), size)) {
    return std::nullopt;
  }
  return text;
}

bool isName(const std::string& text) {
  return text.size() > 1 && text.back() == '\0' &&
         std::all_of(text.begin(), text.end() - 1, [](char c) { return c >= ' ' && c <= '~'; });
}

/// Whether a property is no size of images, or one that a camera has: width, height, and rate follow.
bool isModestSize(std::ifstream& stream, const std::string& name, std::uint64_t at, std::uint32_t bytes) {
  if (!name.starts_with("xnMapOutputMode")) return true;
  const auto width = readAt<std::uint32_t>(stream, at);
  const auto height = readAt<std::uint32_t>(stream, at + sizeof(std::uint32_t));
  return bytes >= 2 * sizeof(std::uint32_t) && width && height && *width <= kLongestSide_px &&
         *height <= kLongestSide_px && *width * *height <= kMostPixels;
}

/// Whether the lengths in the fields are correct, the name is ASCII, and images have a modest size. OpenNI2
/// indexes a table by the name's letters and reads out of bounds for others.
bool areFieldsSound(std::ifstream& stream, std::uint64_t at, const RecordHeader& record) {
  const bool is_property = record.type >= kFirstProperty && record.type <= kLastProperty;
  const bool is_node = std::ranges::count(kNodeAdded, record.type) > 0;
  if (!is_property && !is_node) {
    return true;
  }
  const std::uint32_t fields = record.fields_bytes - kHeaderBytes;
  constexpr std::uint32_t kLength = sizeof(std::uint32_t);
  const auto name_bytes = readAt<std::uint32_t>(stream, at + kHeaderBytes);
  if (fields < kLength || !name_bytes || *name_bytes > fields - kLength) {
    return false;
  }
  const auto name = readText(stream, at + kHeaderBytes + kLength, *name_bytes);
  if (!name || !isName(*name)) {
    return false;
  }
  const std::uint32_t rest = fields - kLength - *name_bytes;
  const auto value_bytes = readAt<std::uint32_t>(stream, at + kHeaderBytes + kLength + *name_bytes);
  if (!is_property) return true;
  const std::uint64_t value = at + kHeaderBytes + kLength + *name_bytes + kLength;
  return rest >= kLength && value_bytes && *value_bytes <= rest - kLength &&
         isModestSize(stream, *name, value, *value_bytes);
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
        record->fields_bytes > kLargestRecord || record->payload_bytes > kLargestRecord ||
        !areFieldsSound(stream, at, *record)) {
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
