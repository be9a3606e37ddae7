#pragma once
#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Refuses stride < 1, start < 0, frames < 1, and an impossible depth scale or intrinsics. Error: names the
/// value.
[[nodiscard]] Result<void> checkSourceOptions(const SourceOptions& options);

/// Refuses a depth scale (units per metre) that is not positive or exceeds the precision of float. Error:
/// names the value and `origin` ("--depth-scale", a file).
[[nodiscard]] Result<void> checkDepthScale(double units_per_meter, const std::string& origin);

/// The positions start, start + stride, ... below `available`, at most `frames` of them. Error: start is at
/// or beyond the end; names the number of frames.
[[nodiscard]] Result<std::vector<std::size_t>> selectFrames(std::size_t available,
                                                            const SourceOptions& options,
                                                            const std::string& source_name);

}  // namespace scantrove
