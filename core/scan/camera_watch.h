#pragma once
#include "core/capture/frame_source.h"
#include "core/scan/scan_event.h"

namespace scantrove {

/// Reports once when the camera of a scan is lost, and once when it is back. One thread.
class CameraWatch {
 public:
  /// Call with each result of the source. True: the camera was lost before this frame.
  [[nodiscard]] bool follow(const FrameRead& read, const SourceInfo& info, const ScanListener& listener);

 private:
  bool is_lost_ = false;
};

}  // namespace scantrove
