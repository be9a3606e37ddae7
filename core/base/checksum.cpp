#include "core/base/checksum.h"

#include <libdeflate.h>

namespace scantrove {

std::uint32_t crc32Of(std::span<const char> bytes, std::uint32_t crc) {
  // For zero bytes libdeflate returns the initial value, whatever `crc` is.
  return bytes.empty() ? crc : libdeflate_crc32(crc, bytes.data(), bytes.size());
}

}  // namespace scantrove
