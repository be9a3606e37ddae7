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

/// A temporary file of compressed records, for parts of a map that have no room in memory. The file has no
/// name: nothing is left of it however the program ends. Space of records that were taken out is used again.
/// One thread.
class BrickStore {
 public:
  /// Where a record lies; the store remembers none.
  struct Record {
    std::uint64_t offset = 0;
    std::uint32_t stored_bytes = 0;  ///< compressed
    std::uint32_t bytes = 0;
    std::uint64_t checksum = 0;  ///< of what is stored
  };

  /// Nothing happens in `folder` before the first record. `most_bytes`: the file grows no larger.
  explicit BrickStore(std::filesystem::path folder,
                      std::uint64_t most_bytes = std::numeric_limits<std::uint64_t>::max());
  BrickStore(const BrickStore&) = delete;
  BrickStore& operator=(const BrickStore&) = delete;
  ~BrickStore();

  /// Writes 32-bit words, a record of less than 1 GiB. Error: no such folder, the disk is full, ...; then
  /// everything is as before.
  [[nodiscard]] Result<Record> put(std::span<const std::uint32_t> words);

  /// What was put. Error: it cannot be read, or is not what was written.
  [[nodiscard]] Result<std::vector<std::uint32_t>> get(const Record& record) const;

  /// Gives the record's space back.
  void erase(const Record& record);

  /// Of the disk, without holes.
  [[nodiscard]] std::uint64_t usedBytes() const { return used_bytes_; }
  /// Of the file, with holes.
  [[nodiscard]] std::uint64_t fileBytes() const { return end_; }

 private:
  [[nodiscard]] Result<void> open();
  /// Space of so many bytes, made sure of on the disk.
  [[nodiscard]] Result<std::uint64_t> take(std::uint64_t bytes);
  void giveBack(std::uint64_t offset, std::uint64_t bytes);
  [[nodiscard]] Error writeFailure(int code) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
  int file_ = -1;
  std::map<std::uint64_t, std::uint64_t> holes_;  ///< offset -> bytes; none touch
  std::uint64_t end_ = 0;
  std::uint64_t allocated_ = 0;  ///< of the file, on the disk
  std::uint64_t used_bytes_ = 0;
};

/// Where such files go: TMPDIR if it is set, else /var/tmp (a disk where /tmp may be memory), else /tmp.
[[nodiscard]] std::filesystem::path folderForBricks();

}  // namespace scantrove
