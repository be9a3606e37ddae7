#pragma once
#include <cstddef>

#include "core/compute/opencl.h"

namespace scantrove {

/// `bytes` of zeroed host memory for a CPU device; untouched pages take no memory. Freed with the last
/// handle. Throws cl::Error (out of memory).
[[nodiscard]] cl::Buffer zeroedOnHost(const cl::Context& context, std::size_t bytes);

}  // namespace scantrove
