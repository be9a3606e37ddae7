#pragma once
#include <cstdint>
#include <list>
#include <memory>

#include "core/base/result.h"
#include "core/capture/containers/decompression.h"
#include "core/capture/containers/random_access_file.h"

namespace scantrove {

/// A compressed part of a file with many messages.
struct FileChunk {
  std::uint64_t offset = 0;  ///< of its data in the file
  std::uint64_t stored_bytes = 0;
  std::uint64_t bytes = 0;  ///< decompressed
  Compression compression = Compression::none;
};

/// Loads chunks and holds the last ones, because neighbouring messages lie in the same chunk. One thread.
class ChunkCache {
 public:
  /// The chunk's bytes. Error: names the file; damaged, too large, truncated.
  [[nodiscard]] Result<std::shared_ptr<const ByteBlock>> load(const RandomAccessFile& file,
                                                              const FileChunk& chunk);

 private:
  struct Loaded {
    std::uint64_t offset = 0;
    std::shared_ptr<const ByteBlock> bytes;
  };
  std::list<Loaded> loaded_;  // the newest first
};

}  // namespace scantrove
