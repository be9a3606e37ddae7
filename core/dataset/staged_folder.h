#pragma once
#include <filesystem>
#include <memory>

#include "core/base/result.h"

namespace scantrove {

/// A folder that appears whole or not at all: it is filled as `FOLDER.part-XXXXXX` beside its place and
/// renamed. Unless committed it is removed with this object. A killed program leaves it behind; the next one
/// for the same place removes it if it carries our marker file and no running program has locked it.
class StagedFolder {
 public:
  /// The marker's file name; no finished folder holds it.
  static constexpr const char* kMarker = ".scantrove-unfinished";

  /// Makes the staged folder, and missing parents of `place`. Error: something is in `place` already, it is
  /// no folder, or its parent cannot be written to; names the path and what to do.
  [[nodiscard]] static Result<StagedFolder> create(const std::filesystem::path& place);

  StagedFolder(StagedFolder&&) noexcept;
  StagedFolder& operator=(StagedFolder&&) noexcept;
  ~StagedFolder();

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Where it will be, absolute.
  [[nodiscard]] const std::filesystem::path& place() const { return place_; }

  /// Brings all files to the disk and renames. Error: the disk failed, or the place has been taken meanwhile.
  [[nodiscard]] Result<void> commit();

  /// The same error for a person, who knows `place` only.
  [[nodiscard]] Error inFinalWords(Error error) const;

 private:
  StagedFolder(std::filesystem::path place, std::filesystem::path path, int lock);
  void discard() noexcept;

  std::filesystem::path place_, path_;
  int lock_ = -1;  // an open descriptor of the staged folder
};

}  // namespace scantrove
