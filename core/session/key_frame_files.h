#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/session/saved_scan.h"

namespace scantrove {

class SessionStore;

/// Writes a frame's images into a session without replacing files. Colour: the recorded bytes without an
/// orientation (a JPEG without one stays unchanged), else PNG. Depth: 16-bit PNG. The session's thread.
/// Error: names the file.
[[nodiscard]] Result<SavedKeyFrame> writeKeyFrame(SessionStore& session, int number, const RgbdFrame& frame);

/// Reads the frame. Any thread. Error: a file is missing, damaged, or not the one written; names it.
[[nodiscard]] Result<RgbdFrame> readKeyFrame(const std::filesystem::path& session_folder,
                                             const SavedKeyFrame& key_frame, const SavedFrame& frame);

}  // namespace scantrove
