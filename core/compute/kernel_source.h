#pragma once
#include <string_view>

namespace scantrove {

/// The text of an OpenCL file, or of all files of a module, embedded at build time with includes expanded and
/// `#line` directives.
struct KernelSource {
  /// Relative to the repository root: core/fusion/kernels/reduce_depth.cl, or core/fusion/kernels for all.
  std::string_view path;
  std::string_view text;
};

}  // namespace scantrove
