#pragma once
#include <exception>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// Whether a device ran out of memory.
[[nodiscard]] bool isOutOfMemory(const cl::Error& error);

/// Message for the current exception: the device's, memory's or a library's. `activity` is the interrupted
/// work, such as "writing the labelled cloud". Call inside a catch block only.
[[nodiscard]] Error describeCurrentException(const std::string& activity);

/// Runs `work`, which returns a Result. Exceptions of libraries (device failure, out of memory) become errors
/// that name `activity`.
template <class Work>
[[nodiscard]] auto guarded(const std::string& activity, Work&& work) -> std::invoke_result_t<Work> {
  try {
    return std::forward<Work>(work)();
  } catch (const std::exception&) {
    return fail(describeCurrentException(activity));
  }
}

}  // namespace scantrove
