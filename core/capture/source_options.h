#pragma once
#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Refuses stride < 1, start < 0, frames < 1, depth_scale not positive and finite, focal lengths not
/// positive. Error: names the value.
[[nodiscard]] Result<void> checkSourceOptions(const SourceOptions& options);

/// The positions start, start + stride, ... below `available`, at most `frames` of them.
/// Error: start is at or beyond the end; names the number of frames there are.
[[nodiscard]] Result<std::vector<std::size_t>> selectFrames(std::size_t available,
                                                            const SourceOptions& options,
                                                            const std::string& source_name);

}  // namespace scantrove
