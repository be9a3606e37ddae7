#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// A temporary file of compressed records, for parts of a map that do not fit in memory. The file has no
/// name, so that it disappears however the program ends. Space of erased records is reused. One thread.
class BrickStore {
 public:
  /// Location of a record; the store keeps no list of them.
  struct Record {
    std::uint64_t offset = 0;
    std::uint32_t stored_bytes = 0;  ///< compressed
    std::uint32_t bytes = 0;
    std::uint64_t checksum = 0;  ///< of the compressed bytes
  };

  /// Creates the file with the first record. `most_bytes`: maximum size of the file.
  explicit BrickStore(std::filesystem::path folder,
                      std::uint64_t most_bytes = std::numeric_limits<std::uint64_t>::max());
  BrickStore(const BrickStore&) = delete;
  BrickStore& operator=(const BrickStore&) = delete;
  ~BrickStore();

  /// Writes 32-bit words, less than 1 GiB, as a record. On an error (no such folder, disk full, ...) nothing
  /// changes.
  [[nodiscard]] Result<Record> put(std::span<const std::uint32_t> words);

  /// The words of a record. Error if it cannot be read or its checksum differs.
  [[nodiscard]] Result<std::vector<std::uint32_t>> get(const Record& record) const;

  /// Frees the record's space.
  void erase(const Record& record);

  /// Bytes of records, without holes.
  [[nodiscard]] std::uint64_t usedBytes() const { return used_bytes_; }
  /// Size of the file, with holes.
  [[nodiscard]] std::uint64_t fileBytes() const { return end_; }

 private:
  [[nodiscard]] Result<void> open();
  /// Reserves `bytes` on the disk; returns their offset.
  [[nodiscard]] Result<std::uint64_t> take(std::uint64_t bytes);
  void giveBack(std::uint64_t offset, std::uint64_t bytes);
  [[nodiscard]] Error writeFailure(int code) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
  int file_ = -1;
  std::map<std::uint64_t, std::uint64_t> holes_;  ///< offset -> bytes; never adjacent
  std::uint64_t end_ = 0;
  std::uint64_t allocated_ = 0;  ///< of the file, on the disk
  std::uint64_t used_bytes_ = 0;
};

/// Folder for such files: TMPDIR if set, else /var/tmp (on disk, while /tmp may be in memory), else /tmp.
[[nodiscard]] std::filesystem::path folderForBricks();

}  // namespace scantrove
