#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"

namespace scantrove {

/// The record of an exported data set: which files the program wrote into its folder, with size and checksum.
/// By it a later export replaces its own files and no others. It is a file of the data set itself.
class ExportRecord {
 public:
  static constexpr const char* kFile = ".scantrove-export.json";

  struct File {
    std::uintmax_t bytes = 0;
    std::uint32_t crc = 0;  ///< CRC-32
    bool operator==(const File&) const = default;
  };

  /// `format`: of the data set ("coco").
  explicit ExportRecord(std::string format) : format_(std::move(format)) {}

  /// Reads the record in `folder`; none: there is none. Error: damaged, or of a newer version.
  [[nodiscard]] static Result<std::optional<ExportRecord>> read(const std::filesystem::path& folder);

  [[nodiscard]] const std::string& format() const { return format_; }
  /// By path in the folder.
  [[nodiscard]] const std::map<std::filesystem::path, File>& files() const { return files_; }
  void add(const std::filesystem::path& name, std::string_view bytes);
  /// Adds a file of `folder` that was written. Error: it cannot be read.
  [[nodiscard]] Result<void> addWritten(const std::filesystem::path& folder,
                                        const std::filesystem::path& name);

  /// Writes kFile into `folder`.
  [[nodiscard]] Result<void> writeTo(const std::filesystem::path& folder) const;

  /// Error: `folder` has a file that is not recorded or that was changed, or a folder without recorded files;
  /// names it. Our marker of a staged folder may be there (hasOurMarker), and files may be missing.
  [[nodiscard]] Result<void> checkUnchanged(const std::filesystem::path& folder) const;

  /// Removes recorded files that are unchanged, the record, our marker, and folders that are empty then.
  /// Returns whether all of `folder` is gone.
  bool removeFrom(const std::filesystem::path& folder) const;

 private:
  [[nodiscard]] bool isUnchanged(const std::filesystem::path& file, const File& recorded) const;

  std::string format_;
  std::map<std::filesystem::path, File> files_;
};

}  // namespace scantrove
