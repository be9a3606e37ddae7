#pragma once
#include <memory>

#include "core/capture/containers/message_file.h"
#include "core/capture/containers/opening_progress.h"

namespace scantrove {

/// Whether a file begins as a SQLite database.
[[nodiscard]] bool isSqlite(ByteView start);

/// Opens a database of rosbag2 (.db3): tables `topics` and `messages`. Messages may be compressed by
/// Zstandard. Never writes to the file or beside it. Error: names the file; no database of rosbag2, damaged,
/// without messages.
[[nodiscard]] Result<std::unique_ptr<MessageFile>> openRosbag2Database(const std::filesystem::path& path,
                                                                       OpeningProgress& progress);

}  // namespace scantrove
