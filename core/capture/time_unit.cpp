#include "core/capture/time_unit.h"

#include <algorithm>
#include <array>

namespace scantrove {

namespace {

constexpr TimeUnit kSeconds{1, "seconds"};
constexpr TimeUnit kMilliseconds{1e-3, "milliseconds"};
constexpr TimeUnit kMicroseconds{1e-6, "microseconds"};
constexpr TimeUnit kNanoseconds{1e-9, "nanoseconds"};

/// Threshold for times since 1970: milliseconds (of 1973), microseconds, nanoseconds; seconds reach it in
/// 5138.
constexpr double kMillisecondsSince1970 = 1e11;
constexpr double kMicrosecondsSince1970 = 1e14;
constexpr double kNanosecondsSince1970 = 1e17;
constexpr double kSecondsSince1970 = 1e8;

/// Median step between different times; 0 without any.
double middleStep(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

TimeUnit unitSince1970(double time) {
  if (time >= kNanosecondsSince1970) return kNanoseconds;
  if (time >= kMicrosecondsSince1970) return kMicroseconds;
  return time >= kMillisecondsSince1970 ? kMilliseconds : kSeconds;
}

/// Intersection over union of two time intervals.
double sharedPart(double first_a, double last_a, double first_b, double last_b) {
  const double common = std::min(last_a, last_b) - std::max(first_a, first_b);
  const double all = std::max(last_a, last_b) - std::min(first_a, first_b);
  return common > 0 ? common / all : 0;
}

}  // namespace

TimeUnit unitOfImageTimes(const std::vector<double>& times) {
  constexpr double kLongestStep_s = 4;
  const double step = middleStep(times);
  if (times.empty()) return kSeconds;
  if (step == 0) return unitSince1970(times.front());
  if (step >= 1e6 * kLongestStep_s) return kNanoseconds;
  if (step >= 1e3 * kLongestStep_s) return kMicroseconds;
  const bool is_in_seconds = times.front() >= kSecondsSince1970 && times.front() < kMillisecondsSince1970;
  return step >= kLongestStep_s && !is_in_seconds ? kMilliseconds : kSeconds;
}

TimeUnit unitOfPoseTimes(const Trajectory& poses) {
  std::vector<double> times;
  for (const StampedPose& pose : poses) times.push_back(pose.timestamp_s);
  const TimeUnit unit = unitOfImageTimes(times);
  const bool is_sure = unit != kMilliseconds || times.front() >= kMillisecondsSince1970;
  return is_sure ? unit : kSeconds;
}

TimeUnit unitOfPosesOfImages(const Trajectory& poses, double first_s, double last_s,
                             const TimeUnit& unit_of_images) {
  if (poses.empty()) return unit_of_images;
  TimeUnit best = unit_of_images;
  double best_part = 0;
  for (const TimeUnit& unit : {unit_of_images, kSeconds, kMilliseconds, kMicroseconds, kNanoseconds}) {
    const double part = sharedPart(unit.seconds * poses.front().timestamp_s,
                                   unit.seconds * poses.back().timestamp_s, first_s, last_s);
    if (part <= best_part) continue;
    best = unit;
    best_part = part;
  }
  return best;
}

}  // namespace scantrove
