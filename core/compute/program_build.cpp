#include "core/compute/program_build.h"

namespace scantrove {

Result<cl::Program> buildProgram(const cl::Context& context, const cl::Device& device,
                                 const KernelSource& source, const std::string& build_options) {
  // -w: PoCL's compiler writes the number of its warnings to stderr by itself.
  const std::string options = "-cl-std=CL1.2 -w " + build_options;
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
