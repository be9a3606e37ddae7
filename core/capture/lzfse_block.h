#pragma once
#include <string>
#include <string_view>

namespace scantrove {

// Blocks of LZFSE data. Both append to `decoded`, whose earlier bytes matches may repeat, until it has `end`
// bytes. False: damaged or truncated. They never read beyond `payload` nor write beyond `end`.

/// An LZVN block: opcodes, each with literals and a match. `payload`: what follows the block's header.
[[nodiscard]] bool decodeLzvnBlock(std::string_view payload, std::size_t end, std::string& decoded);

/// A block of finite-state entropy codes (version 2). `block`: header and payload. `block_bytes`: set to
/// their size.
[[nodiscard]] bool decodeFseBlock(std::string_view block, std::size_t end, std::string& decoded,
                                  std::size_t& block_bytes);

/// Appends `length` bytes that lie `distance` before the end of `decoded`; they may overlap what is appended.
[[nodiscard]] bool appendMatch(std::string& decoded, std::size_t length, std::size_t distance,
                               std::size_t end);

}  // namespace scantrove
