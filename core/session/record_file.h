#pragma once
#include <cstdint>
#include <filesystem>

#include "core/base/result.h"
#include "core/fusion/packed_words.h"

namespace scantrove {

/// A file of records, each written once at the end of the file and never changed: whatever happens to the
/// program, what was written stays readable. One thread.
class RecordFile {
 public:
  /// Makes a file. Error: there is one of that name; names `path`.
  [[nodiscard]] static Result<RecordFile> create(const std::filesystem::path& path);
  /// Error: there is none, or it is no regular file (links are not followed); names `path`.
  [[nodiscard]] static Result<RecordFile> open(const std::filesystem::path& path);
  RecordFile(RecordFile&& other) noexcept;
  RecordFile& operator=(RecordFile&& other) noexcept;
  ~RecordFile();

  /// Where the record lies. Error: the disk is full, ...; the file's records are as before.
  [[nodiscard]] Result<std::uint64_t> append(const PackedWords& packed);
  /// What is on disk by then survives a power cut, too.
  [[nodiscard]] Result<void> flush();

  /// Of `bytes` at `offset`. Error: there is not so much.
  [[nodiscard]] Result<std::vector<char>> read(std::uint64_t offset, std::uint64_t bytes) const;

  [[nodiscard]] std::uint64_t size() const { return end_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Whether the file is still found under its name; it can be read anyway.
  [[nodiscard]] bool isStillThere() const;

 private:
  RecordFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  [[nodiscard]] static Result<RecordFile> openWith(const std::filesystem::path& path, int flags);

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t end_ = 0;
};

}  // namespace scantrove
