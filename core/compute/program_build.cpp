#include "core/compute/program_build.h"

namespace scantrove {
namespace {

// Requires correctly rounded quotients and roots where the device supports them. A GPU's own rounding would
// make equality (two warps of a thumbnail, say) depend on the device.
std::string roundingOf(const cl::Device& device) {
  const bool can = (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  const bool is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  return can && !is_cpu ? "-cl-fp32-correctly-rounded-divide-sqrt " : "";
}

}  // namespace

Result<cl::Program> buildProgram(const cl::Context& context, const cl::Device& device,
                                 const KernelSource& source, const std::string& build_options) {
  // -w: PoCL's compiler prints its number of warnings to stderr.
  const std::string options = "-cl-std=CL1.2 -w " + roundingOf(device) + build_options;
  cl::Program program(context, std::string(source.text));
  try {
    program.build({device}, options.c_str());
    return program;
  } catch (const cl::Error&) {
    std::string log;
    try {
      log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
    } catch (const cl::Error&) {
      log = "(the driver kept no log)";
    }
    return fail("The kernel file " + std::string(source.path) + " does not build on " +
                    device.getInfo<CL_DEVICE_NAME>() + " with options '" + options + "':\n" + log,
                "Try another device with --device, and please report this message.");
  }
}

}  // namespace scantrove
