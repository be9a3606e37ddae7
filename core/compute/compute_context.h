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

/// A device's total buffer memory and its largest buffer.
struct DeviceMemory {
  std::size_t total_bytes = 0;
  std::size_t largest_buffer_bytes = 0;
};

/// One OpenCL device with its in-order queue and built programs. All work runs on one thread (the scan
/// worker's), or on threads with their own kernels and buffers; profiling supports only one thread. Only
/// construction returns errors. Later device faults in the frame path throw `cl::Error`, which the scan
/// catches at its edges (core/compute/guarded.h).
class ComputeContext {
 public:
  struct Options {
    std::string device;      ///< see chooseDevice
    bool profiling = false;  ///< measure every kernel; see kernelTimes
    int lanes = 0;           ///< see Lanes::choose
    /// Called once, when the driver compiles a kernel that is not in its cache: the next kernels will take
    /// long too.
    std::function<void()> on_compiling = {};
  };

  [[nodiscard]] static Result<std::unique_ptr<ComputeContext>> create(const Options& options);

  ComputeContext(const ComputeContext&) = delete;
  ComputeContext& operator=(const ComputeContext&) = delete;

  /// The kernel `function` of `source`, built on first use with `build_options` and LANES = lanes(), then
  /// cached. Error: the build failed; the message holds device, options and the whole compiler log.
  [[nodiscard]] Result<Kernel> kernel(const KernelSource& source, const std::string& function,
                                      const std::string& build_options = {});

  [[nodiscard]] const cl::Context& context() const { return context_; }
  [[nodiscard]] cl::CommandQueue& queue() { return queue_; }
  [[nodiscard]] const std::string& deviceName() const { return device_name_; }
  [[nodiscard]] const DeviceMemory& memory() const { return memory_; }

  /// True if device memory is host memory, so that mapping a buffer needs no copy.
  [[nodiscard]] bool isCpu() const { return is_cpu_; }

  /// Lanes of all kernels.
  [[nodiscard]] const Lanes& lanes() const { return lanes_; }

  void finish() { queue_.finish(); }

  [[nodiscard]] bool isProfiling() const { return profiling_; }
  /// Device milliseconds by kernel name since creation; empty unless profiling.
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
