#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/compute/kernel.h"
#include "core/compute/kernel_source.h"
#include "core/compute/lanes.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// What a device has for all buffers together, and for the largest of them.
struct DeviceMemory {
  std::size_t total_bytes = 0;
  std::size_t largest_buffer_bytes = 0;
};

/// One OpenCL device with its in-order queue and its built programs. Everything on it runs on one thread
/// (the scan worker's) but what that hands to another, with kernels and buffers of its own; profiling bears
/// only one. Only construction may fail softly. After that a device fault in the frame path throws
/// `cl::Error`, which ends at the edges of the scan (core/compute/guarded.h).
class ComputeContext {
 public:
  struct Options {
    std::string device;      ///< see chooseDevice
    bool profiling = false;  ///< measure every kernel; see kernelTimes
    int lanes = 0;           ///< see Lanes::choose
    /// Called once, at the first kernel that the driver had to compile instead of taking it from its cache:
    /// the rest will take long too.
    std::function<void()> on_compiling = {};
  };

  [[nodiscard]] static Result<std::unique_ptr<ComputeContext>> create(const Options& options);

  ComputeContext(const ComputeContext&) = delete;
  ComputeContext& operator=(const ComputeContext&) = delete;

  /// The kernel `function` of `source`, built on first use with `build_options` and kept. They are told
  /// lanes() as LANES.
  /// Error: the build failed; the message holds device, options and the whole compiler log.
  [[nodiscard]] Result<Kernel> kernel(const KernelSource& source, const std::string& function,
                                      const std::string& build_options = {});

  [[nodiscard]] const cl::Context& context() const { return context_; }
  [[nodiscard]] cl::CommandQueue& queue() { return queue_; }
  [[nodiscard]] const std::string& deviceName() const { return device_name_; }
  [[nodiscard]] const DeviceMemory& memory() const { return memory_; }

  /// True where device memory is the host's: mapping a buffer costs no copy.
  [[nodiscard]] bool isCpu() const { return is_cpu_; }

  /// Of all kernels.
  [[nodiscard]] const Lanes& lanes() const { return lanes_; }

  void finish() { queue_.finish(); }

  [[nodiscard]] bool isProfiling() const { return profiling_; }
  /// Milliseconds spent on the device by kernel name since creation; empty unless profiling.
  [[nodiscard]] const std::map<std::string, double>& kernelTimes() const { return *kernel_times_; }

 private:
  ComputeContext() = default;
  [[nodiscard]] Result<cl::Program> build(const KernelSource& source, const std::string& build_options);

  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  std::string device_name_;
  DeviceMemory memory_;
  bool is_cpu_ = false;
  Lanes lanes_;
  bool profiling_ = false;
  std::function<void()> on_compiling_;
  std::map<std::string, cl::Program> programs_;
  std::shared_ptr<std::map<std::string, double>> kernel_times_ =
      std::make_shared<std::map<std::string, double>>();
};

}  // namespace scantrove
