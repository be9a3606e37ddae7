#pragma once
#include <string>

#include "core/capture/frame_source.h"

namespace scantrove {

/// The metadata key for the part of its recording that a scan reads. Missing or empty: unknown, because the
/// scan is of an older version, or continued with another part.
inline constexpr const char* kPartKey = "part";
/// The part that has all frames.
inline constexpr const char* kWholeRecording = "whole";

/// Which frames of a recording `options` choose, such as "from frame 250, 100 frames"; kWholeRecording: all.
/// Equal choices have equal words.
[[nodiscard]] std::string partInWords(const SourceOptions& options);

}  // namespace scantrove
