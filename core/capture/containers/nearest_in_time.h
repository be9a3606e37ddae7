#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace scantrove {

/// Median interval of sorted times; 0 for fewer than two. Looks at the first 200.
[[nodiscard]] inline std::int64_t medianInterval(std::span<const std::int64_t> times) {
  constexpr std::size_t kMost = 200;
  std::vector<std::int64_t> intervals;
  for (std::size_t i = 1; i < std::min(times.size(), kMost); ++i)
    intervals.push_back(times[i] - times[i - 1]);
  if (intervals.empty()) return 0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::ranges::nth_element(intervals, middle);
  return *middle;
}

/// The longest time between a depth image and its colour image: one interval of the slower stream, because
/// two cameras may be out of step by up to half of one, and deliver late; at least 50 ms.
[[nodiscard]] inline std::int64_t pairTolerance(std::span<const std::int64_t> depth_times,
                                                std::span<const std::int64_t> color_times) {
  constexpr std::int64_t kLeast_ns = 50'000'000;
  return std::max({kLeast_ns, medianInterval(depth_times), medianInterval(color_times)});
}

/// Position of the first element of sorted `times` that is not before `time`, or of the last one if that is
/// nearer. `times` is not empty.
[[nodiscard]] inline std::size_t nearestTime(std::span<const std::int64_t> times, std::int64_t time) {
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
  if (after == times.size()) return after - 1;
  const auto distance = [&](std::size_t i) {
    return times[i] > time ? static_cast<std::uint64_t>(times[i]) - static_cast<std::uint64_t>(time)
                           : static_cast<std::uint64_t>(time) - static_cast<std::uint64_t>(times[i]);
  };
  return after > 0 && distance(after - 1) <= distance(after) ? after - 1 : after;
}

}  // namespace scantrove
