#pragma once
#include <filesystem>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

// PoCL's cache of compiled kernels: CACHE/XX/PROGRAM/program.bc (LLVM bitcode) and a shared library per
// kernel and work-group size. PoCL ends the program on a damaged file, such as a power failure leaves.

/// Whether the headers of a shared library (.so) or bitcode (.bc) show a complete file; misses damage inside.
[[nodiscard]] bool isCompleteKernel(const std::filesystem::path& file);

/// The files below `cache` that are incomplete, or differ from the checksums of recordKernels(). Error: a
/// subfolder cannot be read.
[[nodiscard]] Result<std::vector<std::filesystem::path>> damagedKernels(const std::filesystem::path& cache);

/// Writes checksums of all files below `cache` to a file there. If it cannot be written, there are none.
void recordKernels(const std::filesystem::path& cache);

}  // namespace scantrove
