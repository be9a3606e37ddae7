#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// A new folder for compiled kernels in $TMPDIR, else /tmp, /var/tmp or /dev/shm, that only this user may
/// look into; it holds our marker. Error: none of them can be written to.
[[nodiscard]] Result<std::filesystem::path> makePrivateFolder();

/// Removes such a folder; nothing else.
void removePrivateFolder(const std::filesystem::path& folder);

}  // namespace scantrove
