#pragma once
#include <string_view>

namespace scantrove {

/// The text of an OpenCL file, or of all those of a module together, embedded at build time with its includes
/// expanded and `#line` directives in place.
struct KernelSource {
  /// From the repository's root: core/fusion/kernels/reduce_depth.cl, or core/fusion/kernels of all.
  std::string_view path;
  std::string_view text;
};

}  // namespace scantrove
