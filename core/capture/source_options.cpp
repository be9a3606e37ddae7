#include "core/capture/source_options.h"

#include <cmath>

namespace scantrove {

Result<void> checkSourceOptions(const SourceOptions& options) {
  if (options.start < 0) {
    return fail("The first frame (--start) is " + std::to_string(options.start) + ".",
                "It must be 0 or more.");
  }
  if (options.stride < 1) {
    return fail("The stride (--stride) is " + std::to_string(options.stride) + ".", "It must be 1 or more.");
  }
  if (options.frames && *options.frames < 1) {
    return fail("The number of frames (--frames) is " + std::to_string(*options.frames) + ".",
                "It must be 1 or more.");
  }
  if (options.depth_scale && !(std::isfinite(*options.depth_scale) && *options.depth_scale > 0)) {
    return fail("The depth scale (--depth-scale) is " + std::to_string(*options.depth_scale) + ".",
                "It must be positive: depth units per metre, e.g. 1000 for millimetres, 5000 for TUM.");
  }
  if (options.intrinsics) {
    const Intrinsics& K = *options.intrinsics;
    if (!(std::isfinite(K.fx) && std::isfinite(K.fy) && K.fx > 0 && K.fy > 0)) {
      return fail(
          "The focal lengths (--intrinsics) are " + std::to_string(K.fx) + "," + std::to_string(K.fy) + ".",
          "They must be positive: --intrinsics fx,fy,cx,cy in pixels.");
    }
  }
  return {};
}

Result<std::vector<std::size_t>> selectFrames(std::size_t available, const SourceOptions& options,
                                              const std::string& source_name) {
  const auto start = static_cast<std::size_t>(options.start);
  if (start >= available) {
    return fail(source_name + " has " + std::to_string(available) + " frames; it cannot start at frame " +
                    std::to_string(options.start) + ".",
                "Frames are counted from 0: give a smaller --start.");
  }
  std::vector<std::size_t> selected;
  const std::size_t limit = options.frames ? static_cast<std::size_t>(*options.frames) : available;
  for (std::size_t i = start; i < available && selected.size() < limit;
       i += static_cast<std::size_t>(options.stride)) {
    selected.push_back(i);
  }
  return selected;
}

}  // namespace scantrove
