#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// How much a finished write must outlive.
enum class Durability {
  process,  ///< a killed program: renamed only when complete. Where a file is replaced, as power
  power,    ///< a power cut too: flushed to the disk before the rename
};

/// Makes `path` hold exactly `bytes`: writes a file beside it, then renames. Whoever looks sees the old file,
/// no file, or the whole new one, never half of it. Error: names `path` and the system's reason (full disk,
/// read-only folder, ...).
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                                 Durability durability = Durability::power);

/// The same of bytes that need not be in memory at once: `next` gives one piece after the other, each good
/// until it is asked again, and an empty one at the end.
Result<void> writeFileAtomically(const std::filesystem::path& path,
                                 const std::function<std::string_view()>& next,
                                 Durability durability = Durability::power);

/// Creates `folder` with its parents and proves by a small file that it can be written to. Removes the
/// unfinished files that killed runs left in it (see part_name.h; those of running programs are locked).
/// Error: names `folder` and the system's reason.
Result<void> prepareOutputFolder(const std::filesystem::path& folder);

/// Error: one of `names` in `folder` is there and is no file, so that no result can take its place.
Result<void> checkReplaceable(const std::filesystem::path& folder, std::span<const char* const> names);

}  // namespace scantrove
