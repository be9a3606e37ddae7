#include "tests/pipeline/session/failing_world.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <limits>
#include <mutex>
#include <string>

#include "core/compute/opencl.h"

namespace scantrove::test {
namespace {

constexpr int kAll = std::numeric_limits<int>::max();
std::atomic<int> calls_made{0}, calls_that_work{kAll};

bool deviceWorks() { return calls_made++ < calls_that_work; }

/// The library's function that this program replaces.
template <class Function>
Function* libraryFunction(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

std::mutex disk_mutex;
std::string full_folder;  // guarded by disk_mutex; empty: there is room

bool isFull(int file) {
  const std::scoped_lock lock(disk_mutex);
  if (full_folder.empty()) return false;
  std::array<char, 4096> target{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = ::readlink(link.c_str(), target.data(), target.size());
  return length > 0 && std::string(target.data(), static_cast<std::size_t>(length)).starts_with(full_folder);
}

}  // namespace

void failing_device::count() {
  calls_that_work = kAll;
  calls_made = 0;
}
int failing_device::counted() { return calls_made; }
void failing_device::failAfter(int works) {
  calls_made = 0;
  calls_that_work = works;
}
void failing_device::heal() { calls_that_work = kAll; }

FullDisk::FullDisk(const std::filesystem::path& folder) {
  const std::scoped_lock lock(disk_mutex);
  full_folder = std::filesystem::canonical(folder).string() + '/';
}
FullDisk::~FullDisk() {
  const std::scoped_lock lock(disk_mutex);
  full_folder.clear();
}

}  // namespace scantrove::test

using scantrove::test::deviceWorks;
using scantrove::test::libraryFunction;

extern "C" {

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t* offset, const size_t* global, const size_t* local, cl_uint waits,
                              const cl_event* wait, cl_event* event) {
  static auto* const real = libraryFunction<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
  if (!deviceWorks()) return CL_DEVICE_NOT_AVAILABLE;
  return real(queue, kernel, dimensions, offset, global, local, waits, wait, event);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                           size_t size, void* to, cl_uint waits, const cl_event* wait, cl_event* event) {
  static auto* const real = libraryFunction<decltype(clEnqueueReadBuffer)>("clEnqueueReadBuffer");
  if (!deviceWorks()) return CL_DEVICE_NOT_AVAILABLE;
  return real(queue, buffer, blocking, offset, size, to, waits, wait, event);
}

cl_int clEnqueueWriteBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                            size_t size, const void* from, cl_uint waits, const cl_event* wait,
                            cl_event* event) {
  static auto* const real = libraryFunction<decltype(clEnqueueWriteBuffer)>("clEnqueueWriteBuffer");
  if (!deviceWorks()) return CL_DEVICE_NOT_AVAILABLE;
  return real(queue, buffer, blocking, offset, size, from, waits, wait, event);
}

cl_int clFinish(cl_command_queue queue) {
  static auto* const real = libraryFunction<decltype(clFinish)>("clFinish");
  if (!deviceWorks()) return CL_DEVICE_NOT_AVAILABLE;
  return real(queue);
}

ssize_t write(int file, const void* bytes, size_t count) {
  static auto* const real = libraryFunction<ssize_t(int, const void*, size_t)>("write");
  if (scantrove::test::isFull(file)) {
    errno = ENOSPC;
    return -1;
  }
  return real(file, bytes, count);
}

}  // extern "C"
