#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is a scan of MultiScan's app: NAME.depth.zlib and NAME.jsonl.
[[nodiscard]] bool isMultiscanFolder(const std::vector<std::string>& names);

/// Its frames, one a line of NAME.jsonl. NAME.json gives size and unit of depth. Error: names the file.
[[nodiscard]] Result<ImageSequence> readMultiscanFolder(const std::filesystem::path& folder,
                                                        const std::vector<std::string>& names);

}  // namespace scantrove
