#include "core/compute/kernel.h"

namespace scantrove {
namespace {

cl::NDRange roundedUp(const cl::NDRange& global, const cl::NDRange& local) {
  const auto up = [&](cl::size_type axis) {
    const cl::size_type step = local.get()[axis];
    return (global.get()[axis] + step - 1) / step * step;
  };
  if (local.dimensions() == 0) return global;
  if (global.dimensions() == 1) return cl::NDRange(up(0));
  if (global.dimensions() == 2) return cl::NDRange(up(0), up(1));
  return cl::NDRange(up(0), up(1), up(2));
}

bool isEmpty(const cl::NDRange& range) {
  for (cl::size_type axis = 0; axis < range.dimensions(); ++axis) {
    if (range.get()[axis] == 0) return true;
  }
  return false;
}

}  // namespace

void Kernel::enqueue(const cl::NDRange& global, const cl::NDRange& local) {
  if (isEmpty(global)) return;
  if (!times_) {
    queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, roundedUp(global, local), local);
    return;
  }
  cl::Event event;
  queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, roundedUp(global, local), local, nullptr, &event);
  event.wait();
  const cl_ulong duration_ns = event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                               event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  (*times_)[name_] += static_cast<double>(duration_ns) * 1e-6;
}

}  // namespace scantrove
