#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Reads files of a zip archive by libzip, each when it is asked for. One thread at a time.
class ZipArchive {
 public:
  /// Reads the directory only. Error: names the file; unreadable, or no zip archive.
  [[nodiscard]] static Result<std::shared_ptr<ZipArchive>> open(const std::filesystem::path& file);

  [[nodiscard]] bool contains(const std::string& name) const;

  /// The content of `name`. Error: names archive and `name`; missing, encrypted, damaged, larger than
  /// `max_bytes`.
  [[nodiscard]] Result<std::string> read(const std::string& name, std::uint64_t max_bytes) const;

  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;
  ~ZipArchive();

 private:
  struct Handle;
  explicit ZipArchive(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> handle_;
};

}  // namespace scantrove
