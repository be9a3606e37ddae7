#pragma once
#include <memory>

#include "core/capture/containers/message_file.h"
#include "core/capture/containers/opening_progress.h"

namespace scantrove {

/// Whether a file begins as an MCAP file.
[[nodiscard]] bool isMcap(ByteView start);

/// Opens an MCAP file with chunks that are stored, lz4 or zstd, or without chunks. Reads the index after each
/// chunk, so that a file without its end opens as well, with a warning; chunks without an index are
/// decompressed. Error: names the file; damaged, without messages.
[[nodiscard]] Result<std::unique_ptr<MessageFile>> openMcap(const std::filesystem::path& path,
                                                            OpeningProgress& progress);

}  // namespace scantrove
