#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// A layout of recordings in folders, recognised by looking at the folder's files.
struct FolderFormat {
  const char* name;
  bool (*fits)(const std::filesystem::path& folder, const std::vector<std::string>& names);
  Result<std::unique_ptr<FrameSource>> (*open)(const std::filesystem::path& folder,
                                               const std::vector<std::string>& names,
                                               const SourceOptions& options);
};

/// All layouts, the most particular first; the last one, images of any names, is also what most others are.
[[nodiscard]] const std::vector<FolderFormat>& folderFormats();

/// The first layout that fits, or null. If several but the last fit, a warning says which is taken. `names`:
/// the folder's files.
[[nodiscard]] const FolderFormat* findFolderFormat(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& names);

}  // namespace scantrove
