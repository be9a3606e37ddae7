#pragma once
#include <string_view>

namespace scantrove {

/// The text of an OpenCL file, embedded at build time with its includes expanded and `#line` directives in
/// place.
struct KernelSource {
  std::string_view path;  ///< from the repository's root, e.g. core/fusion/kernels/integrate_bricks.cl
  std::string_view text;
};

}  // namespace scantrove
