#pragma once
#include <memory>

#include "core/capture/containers/message_file.h"
#include "core/capture/containers/opening_progress.h"

namespace scantrove {

/// Whether a file begins as a ROS 1 bag of any version.
[[nodiscard]] bool isRosBag(ByteView start);

/// Opens a bag of version 2.0 with chunks that are stored, lz4 or bz2. Reads the index after each chunk, so
/// that a bag without its end (the recorder was killed) opens as well, with a warning. Error: names the file;
/// another version, encrypted, damaged, without messages.
[[nodiscard]] Result<std::unique_ptr<MessageFile>> openRosBag(const std::filesystem::path& path,
                                                              OpeningProgress& progress);

}  // namespace scantrove
