#pragma once
#include <cstdint>
#include <filesystem>

#include "core/base/result.h"
#include "core/fusion/packed_words.h"

namespace scantrove {

/// A file of records, each appended once and never changed, so that written records survive a crash. One
/// thread.
class RecordFile {
 public:
  /// Creates a file. Error: the name exists; names `path`.
  [[nodiscard]] static Result<RecordFile> create(const std::filesystem::path& path);
  /// Opens a file. Error: missing, or no regular file (links are not followed); names `path`.
  [[nodiscard]] static Result<RecordFile> open(const std::filesystem::path& path);
  RecordFile(RecordFile&& other) noexcept;
  RecordFile& operator=(RecordFile&& other) noexcept;
  ~RecordFile();

  /// Returns the record's offset. Error: the disk is full, ...; existing records are unchanged.
  [[nodiscard]] Result<std::uint64_t> append(const PackedWords& packed);
  /// Syncs to disk: everything written so far survives a power cut.
  [[nodiscard]] Result<void> flush();

  /// Reads `bytes` at `offset`. Error: the file is shorter.
  [[nodiscard]] Result<std::vector<char>> read(std::uint64_t offset, std::uint64_t bytes) const;

  [[nodiscard]] std::uint64_t size() const { return end_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Whether the file still has its name; it can be read anyway.
  [[nodiscard]] bool isStillThere() const;

 private:
  RecordFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  [[nodiscard]] static Result<RecordFile> openWith(const std::filesystem::path& path, int flags);

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t end_ = 0;
};

}  // namespace scantrove
