#pragma once
#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scantrove::test {

inline std::string littleEndianBytes(std::uint64_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xFFU);
  return bytes;
}

/// A zip archive of uncompressed files (PKWARE's APPNOTE, 4.3): local headers, central directory, its end.
inline std::string zipBytes(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
    const std::string common = littleEndianBytes(10, 2) + std::string(8, '\0') + littleEndianBytes(crc, 4) +
                               littleEndianBytes(content.size(), 4) + littleEndianBytes(content.size(), 4) +
                               littleEndianBytes(name.size(), 2) + littleEndianBytes(0, 2);
    directory += "PK\x01\x02" + littleEndianBytes(10, 2) + common + std::string(10, '\0') +
                 littleEndianBytes(archive.size(), 4) + name;
    archive += "PK\x03\x04" + common + name + content;
  }
  return archive + directory + "PK\x05\x06" + std::string(4, '\0') + littleEndianBytes(files.size(), 2) +
         littleEndianBytes(files.size(), 2) + littleEndianBytes(directory.size(), 4) +
         littleEndianBytes(archive.size(), 4) + littleEndianBytes(0, 2);
}

/// `content` as LZFSE data of one stored block.
inline std::string storedLzfse(const std::string& content) {
  return "bvx-" + littleEndianBytes(content.size(), 4) + content + "bvx$";
}

}  // namespace scantrove::test
