#include "core/compute/compute_context.h"

#include <ctime>
#include <utility>

#include "core/compute/device_choice.h"
#include "core/compute/program_build.h"

namespace scantrove {
namespace {

// PoCL needs 0.6 s of this thread's time to compile even a small kernel, and 0.025 s to load one from its
// cache.
constexpr double kCompiling_s = 0.12;

/// CPU time of this thread in seconds, which excludes waiting on a busy machine.
double threadTime() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Result<std::unique_ptr<ComputeContext>> ComputeContext::create(const Options& options) {
  Result<cl::Device> device = chooseDevice(options.device);
  if (!device) return fail(device.error());
  std::unique_ptr<ComputeContext> compute(new ComputeContext);
  compute->device_ = *device;
  compute->device_name_ = device->getInfo<CL_DEVICE_NAME>();
  compute->device_name_.resize(std::char_traits<char>::length(compute->device_name_.c_str()));
  compute->memory_ = {device->getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>(),
                      device->getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>()};
  compute->is_cpu_ = (device->getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  compute->profiling_ = options.profiling;
  compute->on_compiling_ = options.on_compiling;
  SCANTROVE_TRY(moveInto(compute->lanes_, Lanes::choose(*device, options.lanes)));
  try {
    compute->context_ = cl::Context(*device);
    compute->queue_ =
        cl::CommandQueue(compute->context_, *device, options.profiling ? CL_QUEUE_PROFILING_ENABLE : 0);
  } catch (const cl::Error& error) {
    return fail("The OpenCL device " + compute->device_name_ + " could not be opened (" + error.what() +
                    ", code " + std::to_string(error.err()) + ").",
                "Choose another with --device; 'scantrove devices' lists them.");
  }
  return compute;
}

Result<Kernel> ComputeContext::kernel(const KernelSource& source, const std::string& function,
                                      const std::string& build_options) {
  const std::string options = "-DLANES=" + std::to_string(lanes_.count()) + " " + build_options;
  const std::string key = std::string(source.path) + '\n' + options;
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    Result<cl::Program> program = build(source, options);
    if (!program) return fail(program.error());
    found = programs_.emplace(key, std::move(*program)).first;
  }
  try {
    return Kernel(cl::Kernel(found->second, function.c_str()), queue_, function,
                  profiling_ ? kernel_times_ : nullptr);
  } catch (const cl::Error&) {
    return fail("The kernel " + function + " is not in " + std::string(source.path) + ".");
  }
}

Result<cl::Program> ComputeContext::build(const KernelSource& source, const std::string& build_options) {
  const double start_s = threadTime();
  Result<cl::Program> program = buildProgram(context_, device_, source, build_options);
  if (on_compiling_ && threadTime() - start_s > kCompiling_s) std::exchange(on_compiling_, nullptr)();
  return program;
}

}  // namespace scantrove
