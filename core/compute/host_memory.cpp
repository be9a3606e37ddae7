#include "core/compute/host_memory.h"

#include <sys/mman.h>

#include <memory>

namespace scantrove {
namespace {

struct Mapping {
  explicit Mapping(std::size_t size)
      : bytes(size),
        start(::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1,
                     0)) {
    if (start == MAP_FAILED) throw cl::Error(CL_MEM_OBJECT_ALLOCATION_FAILURE, "mmap");
  }
  ~Mapping() { ::munmap(start, bytes); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  std::size_t bytes;
  void* start;
};

void CL_CALLBACK unmap(cl_mem /*buffer*/, void* mapping) { delete static_cast<Mapping*>(mapping); }

}  // namespace

cl::Buffer zeroedOnHost(const cl::Context& context, std::size_t bytes) {
  auto mapping = std::make_unique<Mapping>(bytes);
  cl::Buffer buffer(context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, mapping->start);
  buffer.setDestructorCallback(&unmap, mapping.get());
  static_cast<void>(mapping.release());  // the buffer owns it now
  return buffer;
}

}  // namespace scantrove
