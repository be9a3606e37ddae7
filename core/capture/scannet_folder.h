#pragma once
#include <filesystem>
#include <memory>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether a folder has ScanNet's `depth/`, `pose/` and `intrinsic/intrinsic_depth.txt` (SensReader), or
/// `intrinsics_depth.txt` (scannet_frames_25k).
[[nodiscard]] bool isScannetFolder(const std::filesystem::path& folder);

/// A scene extracted from ScanNet's .sens: `color/N.jpg`, `depth/N.png` in mm, `pose/N.txt` camera-to-world
/// (-inf = none). Colour and depth have cameras of their own. Images are paired by pairFolders(). Error:
/// names the file.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openScannetFolder(const std::filesystem::path& folder,
                                                                     const SourceOptions& options);

}  // namespace scantrove
