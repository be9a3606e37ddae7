#pragma once

namespace scantrove {

/// Counts of a scan's frames so far.
struct FrameCounts {
  int read = 0;     ///< reached the pipeline
  int tracked = 0;  ///< of those read
  int lost = 0;     ///< of those read
  int relocalized = 0;
  int by_device = 0;  ///< of those tracked, by the motion of a device that tracks itself alone
  int dropped = 0;    ///< live camera only
  int skipped = 0;    ///< unreadable frames of the recording

  /// Frames of the recording that the scan has passed.
  [[nodiscard]] int done() const { return read + skipped; }
};

}  // namespace scantrove
