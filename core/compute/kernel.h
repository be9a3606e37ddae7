#pragma once
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/compute/buffer.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// A built kernel bound to its context's queue. Launch on the context's thread.
class Kernel {
 public:
  using Times = std::map<std::string, double>;

  Kernel() = default;
  Kernel(cl::Kernel kernel, cl::CommandQueue queue, std::string name, std::shared_ptr<Times> times)
      : kernel_(std::move(kernel)),
        queue_(std::move(queue)),
        name_(std::move(name)),
        times_(std::move(times)) {}

  /// Enqueues the kernel over `global` work-items in groups of `local` (cl::NullRange: the driver's choice).
  /// `global` is rounded up to a multiple of `local`, so kernels check their bounds. Arguments: Buffer<T>, or
  /// values of the type that the kernel declares. Throws cl::Error on a device fault.
  template <class... Arguments>
  void launch(const cl::NDRange& global, const cl::NDRange& local, const Arguments&... arguments) {
    cl_uint index = 0;
    (setArgument(index++, arguments), ...);
    enqueue(global, local);
  }

 private:
  template <class T>
  void setArgument(cl_uint index, const Buffer<T>& buffer) {
    kernel_.setArg(index, buffer.cl());
  }
  template <class T>
  void setArgument(cl_uint index, const T& value) {
    kernel_.setArg(index, value);
  }
  void enqueue(const cl::NDRange& global, const cl::NDRange& local);

  cl::Kernel kernel_;
  cl::CommandQueue queue_;
  std::string name_;
  std::shared_ptr<Times> times_;
};

}  // namespace scantrove
