#pragma once
#include <string_view>
#include <vector>

#include "core/base/stamped_pose.h"

namespace scantrove {

/// What numbers count that stand for times in text files or in names.
struct TimeUnit {
  double seconds = 1;
  std::string_view name = "seconds";
  bool operator==(const TimeUnit&) const = default;
};

/// The unit of the times of a recording's images (sorted): images follow each other within four
/// milliseconds to four seconds, and half of them decide. A single time is taken for one since 1970.
[[nodiscard]] TimeUnit unitOfImageTimes(const std::vector<double>& times);

/// The unit of the times of poses alone (sorted), which may be few: nanoseconds and microseconds by their
/// spacing, milliseconds since 1970 only.
[[nodiscard]] TimeUnit unitOfPoseTimes(const Trajectory& poses);

/// The unit that brings the times of poses (sorted) best onto those of images, `first_s` to `last_s`; of
/// equally good ones `unit_of_images`.
[[nodiscard]] TimeUnit unitOfPosesOfImages(const Trajectory& poses, double first_s, double last_s,
                                           const TimeUnit& unit_of_images);

}  // namespace scantrove
