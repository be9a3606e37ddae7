#pragma once
#include <filesystem>
#include <memory>

#include "core/capture/folder_pairs.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether a folder has a subfolder `depth` (checked on the disk, since a file may have that name).
[[nodiscard]] bool isNumberedFolder(const std::filesystem::path& folder);

/// A folder with `depth/` and `color/`, `image/` or `rgb/`, one file a frame (Open3D, Redwood), paired by
/// pairFolders(). Depth is of any type of readAnyDepth(): 16-bit depth in mm, floating-point depth in metres,
/// unless options differ. Without a colour folder the recording is depth only. Intrinsics come from options,
/// else a file (see findIntrinsics), else 525 525 319.5 239.5 with a warning. Poses come from
/// `trajectory.log`, else from camera-to-world matrices in `pose/` with the names of the depth images.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openNumberedFolder(const std::filesystem::path& folder,
                                                                      const SourceOptions& options);

}  // namespace scantrove
