#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// Writes a frame's images into a session: colour as it came but for an orientation (a JPEG stays the same
/// bytes without it), else as PNG;
/// depth as 16-bit PNG. Any thread. Error: names the file.
[[nodiscard]] Result<SavedKeyFrame> writeKeyFrame(const std::filesystem::path& session_folder, int number,
                                                  const RgbdFrame& frame);

/// The frame again. Error: a file is missing or damaged; names it.
[[nodiscard]] Result<RgbdFrame> readKeyFrame(const std::filesystem::path& session_folder,
                                             const SavedKeyFrame& key_frame, const SavedFrame& frame);

}  // namespace scantrove
