#include "core/capture/containers/chunk_cache.h"

#include <algorithm>

namespace scantrove {

Result<std::shared_ptr<const ByteBlock>> ChunkCache::load(const RandomAccessFile& file,
                                                          const FileChunk& chunk) {
  constexpr std::size_t kHeldBytes = 64 << 20;
  const auto found = std::ranges::find(loaded_, chunk.offset, &Loaded::offset);
  if (found != loaded_.end()) {
    loaded_.splice(loaded_.begin(), loaded_, found);
    return loaded_.front().bytes;
  }
  if (chunk.stored_bytes > kMaxDecompressedBytes) {
    return fail(file.path().string() + " has a chunk of more than 128 MB.",
                "Record again with smaller chunks.");
  }
  const Result<ByteBlock> stored = file.read(chunk.offset, chunk.stored_bytes);
  if (!stored) return fail(stored.error());
  Result<ByteBlock> bytes = decompress(chunk.compression, *stored, chunk.bytes);
  if (!bytes) {
    return fail(file.path().string() + " is damaged: " + bytes.error().what + ".",
                "Copy or record it again.");
  }
  std::size_t held = bytes->size();
  auto shared = std::make_shared<const ByteBlock>(std::move(*bytes));
  loaded_.push_front({chunk.offset, shared});
  for (auto other = std::next(loaded_.begin()); other != loaded_.end();) {
    held += other->bytes->size();
    other = held > kHeldBytes ? loaded_.erase(other) : std::next(other);
  }
  return shared;
}

}  // namespace scantrove
