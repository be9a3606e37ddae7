#pragma once
#include <cstddef>

#include "core/compute/opencl.h"

namespace scantrove {

/// `bytes` of zeros in the host's memory, which a CPU device works in; of them only pages that something was
/// written to take memory. Freed with the last handle. Throws cl::Error (no room for them).
[[nodiscard]] cl::Buffer zeroedOnHost(const cl::Context& context, std::size_t bytes);

}  // namespace scantrove
