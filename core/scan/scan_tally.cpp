#include "core/scan/scan_tally.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/session/session_recorder.h"

namespace scantrove {
namespace {

/// The accuracy of landmarks is a few centimetres.
constexpr double kReportedDrift_m = 0.10;
constexpr double kClearlyWorse = 1.5;

Error hasDrifted(double drift_m, int frame_index) {
  return {"In frame " + std::to_string(frame_index) + " the camera is back at a place, and the map has it " +
              std::to_string(std::lround(drift_m * 100)) +
              " cm beside where it was: what is seen there now is in the map twice.",
          "Scan shorter rounds, and slowly where there is little to see."};
}

}  // namespace

std::optional<Error> ScanTally::addFrame(const FrameResult& result, int frame_index) {
  ++frames_.read;
  if (result.pose.has_device_jumped) ++drift_.device_jumps;
  for (const LateFrame& late : result.late) {
    --frames_.lost;
    ++frames_.tracked;
    std::erase(lost_frames_, late.index);
    if (first_usable_.size() < SessionRecorder::kFirstFrames) first_usable_.push_back(late.index);
  }
  if (!result.pose.usable()) {
    ++frames_.lost;
    lost_frames_.push_back(frame_index);
    return std::nullopt;
  }
  ++frames_.tracked;
  if (first_usable_.size() < SessionRecorder::kFirstFrames) first_usable_.push_back(frame_index);
  if (result.pose.state == TrackingState::relocalized) ++frames_.relocalized;
  if (result.pose.is_by_device) ++frames_.by_device;
  return measureDrift(result, frame_index);
}

std::optional<Error> ScanTally::measureDrift(const FrameResult& result, int frame_index) {
  if (result.pose.drift_m) {
    ++drift_.corrected_frames;
    drift_.most_corrected_m = std::max(drift_.most_corrected_m, *result.pose.drift_m);
  }
  if (!result.returned) return std::nullopt;
  ++drift_.revisited_key_frames;
  // Reported once, and again when clearly worse.
  const double drift_m = result.returned->drift_m;
  const bool is_reported = drift_m > kReportedDrift_m && drift_m > kClearlyWorse * drift_.most_m;
  drift_.most_m = std::max(drift_.most_m, drift_m);
  return is_reported ? std::optional(hasDrifted(drift_m, frame_index)) : std::nullopt;
}

void ScanTally::restart() {
  frames_.lost += std::exchange(frames_.tracked, 0);
  frames_.relocalized = frames_.by_device = 0;
  drift_ = {};
  const std::vector<int> dropped = std::exchange(first_usable_, {});
  lost_frames_.insert(lost_frames_.end(), dropped.begin(), dropped.end());
  std::ranges::sort(lost_frames_);
}

void ScanTally::startClock() {
  if (!clock_start_) clock_start_ = std::chrono::steady_clock::now();
}

void ScanTally::stopClock() {
  if (clock_start_) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - *clock_start_;
    elapsed_s_ += elapsed.count();
  }
  clock_start_.reset();
}

void ScanTally::fill(ScanReport& report) const {
  report.frames = frames_;
  report.lost_frames = lost_frames_;
  report.drift = drift_;
  report.fps = elapsed_s_ > 0 ? frames_.read / elapsed_s_ : 0;
  const DurationSummary frame_time = summarize(frame_ms_);
  report.frame_median_ms = frame_time.median_ms;
  report.frame_p95_ms = frame_time.p95_ms;
}

}  // namespace scantrove
