#pragma once
#include <filesystem>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

// Compiled kernels as PoCL keeps them in a folder: CACHE/XX/PROGRAM/program.bc (LLVM bitcode) and, per kernel
// and size of its groups, a shared library. PoCL ends the program on a file that is damaged, as a power
// failure leaves one.

/// Whether a shared library (.so) or bitcode (.bc) is complete by its own headers; damage within is not seen.
[[nodiscard]] bool isCompleteKernel(const std::filesystem::path& file);

/// The files below `cache` that are incomplete, or differ from the checksums of recordKernels(). Error: a
/// folder in it cannot be read.
[[nodiscard]] Result<std::vector<std::filesystem::path>> damagedKernels(const std::filesystem::path& cache);

/// Keeps a checksum of each file below `cache`, in a file there. Where it cannot be written, there is none.
void recordKernels(const std::filesystem::path& cache);

}  // namespace scantrove
