#include "core/capture/lzfse_decoder.h"

#include <cstdint>
#include <span>

#include "core/capture/lzfse_block.h"
#include "core/image/file_bytes.h"

namespace scantrove {

namespace {

constexpr std::string_view kEnd = "bvx$", kStored = "bvx-", kLzvn = "bvxn", kFse = "bvx2";
constexpr std::size_t kMagicBytes = 4;

std::size_t lengthAt(std::string_view bytes, std::size_t at) {
  return numberAt({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, at, 4, false);
}

/// Decodes the block at the start of `bytes` and removes it. False: damaged or truncated.
bool decodeBlock(std::string_view& bytes, std::size_t end, std::string& decoded) {
  const std::string_view magic = bytes.substr(0, kMagicBytes);
  std::size_t block_bytes = 0;
  if (magic == kStored) {
    constexpr std::size_t kHeaderBytes = 8;
    const std::size_t length = end - decoded.size();
    block_bytes = kHeaderBytes + length;
    if (block_bytes > bytes.size()) return false;
    decoded += bytes.substr(kHeaderBytes, length);
  } else if (magic == kLzvn) {
    constexpr std::size_t kHeaderBytes = 12;
    block_bytes = kHeaderBytes + lengthAt(bytes, 8);
    if (block_bytes > bytes.size()) return false;
    if (!decodeLzvnBlock(bytes.substr(kHeaderBytes, block_bytes - kHeaderBytes), end, decoded)) return false;
  } else if (magic != kFse || !decodeFseBlock(bytes, end, decoded, block_bytes)) {
    return false;
  }
  bytes.remove_prefix(block_bytes);
  return decoded.size() == end;
}

}  // namespace

Result<std::string> decodeLzfse(std::string_view bytes, std::size_t max_bytes, const std::string& name) {
  std::string decoded;
  while (!bytes.starts_with(kEnd)) {
    constexpr std::size_t kLeastHeaderBytes = 8;
    if (bytes.size() < kLeastHeaderBytes)
      return fail(name + " is truncated: its compressed data has no end.");
    const std::size_t length = lengthAt(bytes, kMagicBytes);
    if (length > max_bytes - decoded.size())
      return fail(name + " decodes to more than the " + std::to_string(max_bytes) + " bytes of an image.");
    if (!decodeBlock(bytes, decoded.size() + length, decoded))
      return fail(name + " is damaged: its LZFSE data cannot be decoded.",
                  "Copy the recording from the device again.");
  }
  return decoded;
}

bool appendMatch(std::string& decoded, std::size_t length, std::size_t distance, std::size_t end) {
  if (length > end - decoded.size()) return false;
  if (length == 0) return true;
  if (distance == 0 || distance > decoded.size()) return false;
  std::size_t from = decoded.size() - distance;
  decoded.reserve(end);
  for (std::size_t i = 0; i < length; ++i) decoded += decoded[from++];
  return true;
}

}  // namespace scantrove
