#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// Durability of a finished write.
enum class Durability {
  process,  ///< survives a killed program: renamed only when complete. If a file is replaced, as power
  power,    ///< also survives a power cut: flushed to the disk before the rename
};

/// Replaces `path` by `bytes` with a temporary file and a rename. Readers see the old file, no file, or the
/// complete new one. Error: names `path` and the system's reason (full disk, read-only folder, ...).
Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                                 Durability durability = Durability::power);

/// The same for streamed bytes: `next` returns one piece at a time, valid until the next call, and an empty
/// one at the end.
Result<void> writeFileAtomically(const std::filesystem::path& path,
                                 const std::function<std::string_view()>& next,
                                 Durability durability = Durability::power);

/// Creates `folder` with its parents and tests it by writing a small file. Removes unfinished files of killed
/// runs (see part_name.h; those of running programs are locked). Error: names `folder` and the system's
/// reason.
Result<void> prepareOutputFolder(const std::filesystem::path& folder);

/// Error: one of `names` in `folder` exists and is no file, so a result cannot replace it.
Result<void> checkReplaceable(const std::filesystem::path& folder, std::span<const char* const> names);

}  // namespace scantrove
