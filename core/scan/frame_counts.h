#pragma once

namespace scantrove {

/// What became of the frames of one scan so far.
struct FrameCounts {
  int read = 0;     ///< reached the pipeline
  int tracked = 0;  ///< of those read
  int lost = 0;     ///< of those read
  int relocalized = 0;
  int dropped = 0;  ///< live camera only
  int skipped = 0;  ///< unreadable frames of the recording

  /// Frames of the recording that are behind the scan.
  [[nodiscard]] int done() const { return read + skipped; }
};

}  // namespace scantrove
