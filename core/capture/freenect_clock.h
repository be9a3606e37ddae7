#pragma once
#include <cstdint>

namespace scantrove {

/// Converts time stamps of a Kinect v1 to seconds: 32-bit ticks of one 60 MHz clock for depth and colour. The
/// counter wraps every 71.6 s.
class FreenectClock {
 public:
  /// Time of a depth image; continues from the previous depth image across wraps.
  [[nodiscard]] double depthSeconds(std::uint32_t ticks) {
    depth_ticks_ = unwrapped(ticks);
    return seconds(depth_ticks_);
  }
  /// Time of a colour image: the candidate nearest to the last depth image.
  [[nodiscard]] double colorSeconds(std::uint32_t ticks) const { return seconds(unwrapped(ticks)); }

 private:
  static constexpr double kTicksPerSecond = 60e6;

  static double seconds(std::int64_t ticks) { return static_cast<double>(ticks) / kTicksPerSecond; }

  [[nodiscard]] std::int64_t unwrapped(std::uint32_t ticks) const {
    if (depth_ticks_ < 0) {
      return std::int64_t{ticks};
    }
    return depth_ticks_ + static_cast<std::int32_t>(ticks - static_cast<std::uint32_t>(depth_ticks_));
  }

  std::int64_t depth_ticks_ = -1;  // none yet
};

}  // namespace scantrove
