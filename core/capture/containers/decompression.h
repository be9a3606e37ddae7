#pragma once
#include <cstdint>
#include <string_view>

#include "core/base/result.h"
#include "core/capture/containers/byte_cursor.h"

namespace scantrove {

/// Compression of a chunk or of a message.
enum class Compression { none, lz4, zstd, bz2 };

/// Maximum decompressed bytes of a chunk or message: no recorder writes larger ones.
inline constexpr std::uint64_t kMaxDecompressedBytes = std::uint64_t{128} << 20;

/// "", "none", "lz4", "zstd" or "bz2". Error: names another compression.
[[nodiscard]] Result<Compression> compressionNamed(std::string_view name);

/// Whether `bytes` begin a frame of Zstandard.
[[nodiscard]] bool isZstd(ByteView bytes);

/// Decompresses a frame (lz4: of lz4's frame format) of exactly `size` bytes. Any thread. Error: too large,
/// damaged; has no file name.
[[nodiscard]] Result<ByteBlock> decompress(Compression compression, ByteView bytes, std::uint64_t size);

/// The first bytes of a frame of Zstandard, at most `limit`, which is at most kMaxDecompressedBytes. Error:
/// damaged, or larger than kMaxDecompressedBytes where `limit` is that.
[[nodiscard]] Result<ByteBlock> decompressZstdStart(ByteView bytes, std::uint64_t limit);

}  // namespace scantrove
