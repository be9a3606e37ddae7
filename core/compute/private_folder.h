#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Creates a folder for compiled kernels in $TMPDIR, else /tmp, /var/tmp or /dev/shm. Only this user can
/// access it; it contains a marker file. Error: none of them can be written to.
[[nodiscard]] Result<std::filesystem::path> makePrivateFolder();

/// Removes such a folder, and nothing else.
void removePrivateFolder(const std::filesystem::path& folder);

}  // namespace scantrove
