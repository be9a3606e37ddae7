#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/dataset/export_record.h"

namespace scantrove {

/// A folder that is created atomically: it is filled as `FOLDER.part-XXXXXX` beside its destination and
/// renamed. Without a commit this object removes it. The next program for the same destination removes the
/// remains of a killed one, if they have our marker file and no running program has locked them. The content
/// tells our marker from a user's file of its name (hasOurMarker), which is never overwritten or removed.
class StagedFolder {
 public:
  /// The marker's file name; no finished folder contains it.
  static constexpr const char* kMarker = ".scantrove-unfinished";

  /// Creates the staged folder, and missing parents of `place`. Error: `place` is not empty or no folder,
  /// or its parent is not writable; names the path and what to do.
  [[nodiscard]] static Result<StagedFolder> create(const std::filesystem::path& place);

  /// The same, but a data set of `format` that the program wrote to `place` is replaced on commit, as a
  /// whole. Error: also if `place` has any file that its ExportRecord does not have as it is; names it.
  [[nodiscard]] static Result<StagedFolder> createOver(const std::filesystem::path& place,
                                                       const std::string& format);

  StagedFolder(StagedFolder&&) noexcept;
  StagedFolder& operator=(StagedFolder&&) noexcept;
  ~StagedFolder();

  /// The path to write to.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The destination, absolute.
  [[nodiscard]] const std::filesystem::path& place() const { return place_; }

  /// Syncs all files to disk and renames the folder. An old data set is exchanged with it in one step, where
  /// the file system can do that, and removed. Error: the disk failed, the destination exists by now, or the
  /// old data set was changed by now.
  [[nodiscard]] Result<void> commit();
  /// Where the old folder stays if somebody put something into it during the commit; else empty.
  [[nodiscard]] const std::filesystem::path& leftOver() const { return left_over_; }

  /// The same error with `place`, the only path that the user knows.
  [[nodiscard]] Error inFinalWords(Error error) const;

 private:
  StagedFolder(std::filesystem::path place, std::filesystem::path path, int lock,
               std::optional<ExportRecord> replaced);
  void discard() noexcept;
  [[nodiscard]] Result<void> rename();
  [[nodiscard]] Result<void> replace();
  /// For file systems that cannot exchange folders.
  [[nodiscard]] Result<void> replaceInSteps();
  void removeOld(const std::filesystem::path& folder);

  std::filesystem::path place_, path_, left_over_;
  int lock_ = -1;                         // an open descriptor of the staged folder
  std::optional<ExportRecord> replaced_;  // of the data set in the place
};

}  // namespace scantrove
