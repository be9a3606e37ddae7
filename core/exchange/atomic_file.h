#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// How much a finished write must outlive.
enum class Durability {
  process,  ///< a killed program: renamed only when complete
  power,    ///< a power cut too: flushed to the disk before the rename
};

/// Makes `path` hold exactly `bytes`: writes a file beside it, then renames. Whoever looks sees the old file,
/// no file, or the whole new one, never half of it. Error: names `path` and the system's reason (full disk,
/// read-only folder, ...).
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                                 Durability durability = Durability::power);

/// The same for libraries that want a file name: `write` is given the name of the file beside (same
/// extension) to fill. When it fails, that file is removed and `path` stays as it was.
Result<void> writeFileAtomically(
    const std::filesystem::path& path,
    const std::function<Result<void>(const std::filesystem::path& beside)>& write,
    Durability durability = Durability::power);

/// Creates `folder` with its parents and proves by a small file that it can be written to.
/// Error: names `folder` and the system's reason.
Result<void> prepareOutputFolder(const std::filesystem::path& folder);

}  // namespace scantrove
