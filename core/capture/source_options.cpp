#include "core/capture/source_options.h"

#include <sstream>

#include "core/capture/camera_intrinsics.h"

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
  if (options.depth_scale) {
    SCANTROVE_TRY(checkDepthScale(*options.depth_scale, "--depth-scale"));
  }
  if (options.intrinsics) {
    SCANTROVE_TRY(checkFocalLengths(*options.intrinsics, "--intrinsics"));
  }
  return {};
}

Result<void> checkDepthScale(double units_per_meter, const std::string& origin) {
  constexpr double kMin = 1e-6;
  constexpr double kMax = 1e12;
  if (units_per_meter >= kMin && units_per_meter <= kMax) {
    return {};
  }
  std::ostringstream value;
  value << units_per_meter;
  return fail("The depth scale " + value.str() + " (" + origin + ") is none that depth images can have.",
              "It is depth units per metre, e.g. --depth-scale 1000 for millimetres, 5000 for TUM.");
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
