#pragma once
#include <filesystem>
#include <memory>

#include "core/base/result.h"

namespace scantrove {

/// A folder that is created atomically: it is filled as `FOLDER.part-XXXXXX` beside its destination and
/// renamed. Without a commit this object removes it. The next program for the same destination removes the
/// remains of a killed one, if they have our marker file and no running program has locked them.
class StagedFolder {
 public:
  /// The marker's file name; no finished folder contains it.
  static constexpr const char* kMarker = ".scantrove-unfinished";

  /// Creates the staged folder, and missing parents of `place`. Error: `place` is not empty or no folder,
  /// or its parent is not writable; names the path and what to do.
  [[nodiscard]] static Result<StagedFolder> create(const std::filesystem::path& place);

  StagedFolder(StagedFolder&&) noexcept;
  StagedFolder& operator=(StagedFolder&&) noexcept;
  ~StagedFolder();

  /// The path to write to.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The destination, absolute.
  [[nodiscard]] const std::filesystem::path& place() const { return place_; }

  /// Syncs all files to disk and renames the folder. Error: the disk failed, or the destination exists by
  /// now.
  [[nodiscard]] Result<void> commit();

  /// The same error with `place`, the only path that the user knows.
  [[nodiscard]] Error inFinalWords(Error error) const;

 private:
  StagedFolder(std::filesystem::path place, std::filesystem::path path, int lock);
  void discard() noexcept;

  std::filesystem::path place_, path_;
  int lock_ = -1;  // an open descriptor of the staged folder
};

}  // namespace scantrove
