#pragma once
#include <chrono>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/frame_result.h"
#include "core/scan/frame_counts.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// Counts a scan's frames, and measures drift and duration.
class ScanTally {
 public:
  /// `earlier`: of the session, if no frames are added.
  explicit ScanTally(const FrameCounts& earlier) : frames_(earlier) {}

  /// Call after each frame that reached the pipeline. Returns a message about drift, if any.
  [[nodiscard]] std::optional<Error> addFrame(const FrameResult& result, int frame_index);
  void addSkipped() { ++frames_.skipped; }
  void addDropped(int frames) { frames_.dropped += frames; }
  void addFrameTime(double ms) { frame_ms_.push_back(ms); }
  /// The map is replaced by a new one: its frames are lost.
  void restart();

  /// Wall time that counts.
  void startClock();
  void stopClock();

  [[nodiscard]] const FrameCounts& frames() const { return frames_; }
  /// Fills in frames, lost frames, drift and times of `report`.
  void fill(ScanReport& report) const;

 private:
  [[nodiscard]] std::optional<Error> measureDrift(const FrameResult& result, int frame_index);

  FrameCounts frames_;
  std::vector<int> lost_frames_;
  std::vector<int> first_usable_;  // indices of the map's first frames
  MapDrift drift_;
  std::vector<double> frame_ms_;
  double elapsed_s_ = 0;
  std::optional<std::chrono::steady_clock::time_point> clock_start_;
};

}  // namespace scantrove
