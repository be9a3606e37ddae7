#pragma once
#include <string>

#include "core/base/result.h"
#include "core/compute/kernel_source.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// Compiles `source` for `device` as OpenCL C 1.2, with warnings disabled. Error: device, options and the
/// whole compiler log.
[[nodiscard]] Result<cl::Program> buildProgram(const cl::Context& context, const cl::Device& device,
                                               const KernelSource& source, const std::string& build_options);

}  // namespace scantrove
