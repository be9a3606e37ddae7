#pragma once
#include <exception>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// Whether a device has no memory left for what it was asked for.
[[nodiscard]] bool isOutOfMemory(const cl::Error& error);

/// Words for the exception that is being handled: the device's, memory's or a library's. `activity` says what
/// was being done: "writing the labelled cloud". Call inside a catch block only.
[[nodiscard]] Error describeCurrentException(const std::string& activity);

/// Runs `work`, which returns a Result. What it throws (the device failed, memory ran out) becomes an error
/// that names `activity`: the edge where exceptions of the libraries end.
template <class Work>
[[nodiscard]] auto guarded(const std::string& activity, Work&& work) -> std::invoke_result_t<Work> {
  try {
    return std::forward<Work>(work)();
  } catch (const std::exception&) {
    return fail(describeCurrentException(activity));
  }
}

}  // namespace scantrove
