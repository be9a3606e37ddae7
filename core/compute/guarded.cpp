#include "core/compute/guarded.h"

#include <new>

namespace scantrove {
namespace {

constexpr const char* kMemoryAdvice =
    "Scan less at once, or use larger voxels (--set fusion.voxel_size_m=0.01).";

}  // namespace

bool isOutOfMemory(const cl::Error& error) {
  switch (error.err()) {
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_RESOURCES:
    case CL_OUT_OF_HOST_MEMORY:
    case CL_INVALID_BUFFER_SIZE:  // exceeds the device's largest buffer
      return true;
    default:
      return false;
  }
}

Error describeCurrentException(const std::string& activity) {
  try {
    throw;
  } catch (const cl::Error& error) {
    if (isOutOfMemory(error)) return {"The OpenCL device ran out of memory " + activity + ".", kMemoryAdvice};
    return {"The OpenCL device failed " + activity + " (" + error.what() + ", code " +
                std::to_string(error.err()) + ").",
            "Choose another with --device; 'scantrove devices' lists them."};
  } catch (const std::bad_alloc&) {
    return {"Memory ran out " + activity + ".", kMemoryAdvice};
  } catch (const std::exception& error) {
    return {"Something failed " + activity + ": " + error.what() + ".", ""};
  }
}

}  // namespace scantrove
