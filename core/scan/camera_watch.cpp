#include "core/scan/camera_watch.h"

#include <utility>

namespace scantrove {

bool CameraWatch::follow(const FrameRead& read, const SourceInfo& info, const ScanListener& listener) {
  const bool is_known_lost = is_lost_;
  switch (read.status) {
    case FrameRead::Status::timeout:
      is_lost_ = is_lost_ || !read.error.what.empty();
      if (is_lost_ && !is_known_lost) listener(CameraLost{read.error});
      return false;
    case FrameRead::Status::end:
      if (!read.error.what.empty()) listener(CameraLost{read.error});
      return false;
    case FrameRead::Status::frame:
      if (std::exchange(is_lost_, false))
        listener(CameraReturned{{info.name + " is back; the scan goes on.", ""}});
      return read.is_reconnected;
    case FrameRead::Status::skipped:
    case FrameRead::Status::failed:
      break;
  }
  return false;
}

}  // namespace scantrove
