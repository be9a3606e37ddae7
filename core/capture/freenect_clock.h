#pragma once
#include <cstdint>

namespace scantrove {

/// Seconds from the time stamps of a Kinect v1: ticks of one clock of 60 MHz for depth and colour, in 32
/// bits, which begin anew every 71.6 s.
class FreenectClock {
 public:
  /// Of a depth image; goes on from the depth image before, however often the ticks began anew.
  [[nodiscard]] double depthSeconds(std::uint32_t ticks) {
    depth_ticks_ = unwrapped(ticks);
    return seconds(depth_ticks_);
  }
  /// Of a colour image: the time nearest to that of the last depth image.
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
