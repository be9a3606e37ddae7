#pragma once
#include <string_view>
#include <vector>

#include "core/base/stamped_pose.h"

namespace scantrove {

/// Unit of times in text files or file names.
struct TimeUnit {
  double seconds = 1;
  std::string_view name = "seconds";
  bool operator==(const TimeUnit&) const = default;
};

/// The unit of a recording's image times (sorted), by a majority of intervals between four milliseconds and
/// four seconds. A single time is interpreted as time since 1970.
[[nodiscard]] TimeUnit unitOfImageTimes(const std::vector<double>& times);

/// The unit of the times of poses alone (sorted, possibly few): nanoseconds and microseconds by their
/// spacing, milliseconds since 1970 only.
[[nodiscard]] TimeUnit unitOfPoseTimes(const Trajectory& poses);

/// The unit that aligns pose times (sorted) best with image times from `first_s` to `last_s`; ties:
/// `unit_of_images`.
[[nodiscard]] TimeUnit unitOfPosesOfImages(const Trajectory& poses, double first_s, double last_s,
                                           const TimeUnit& unit_of_images);

}  // namespace scantrove
