#pragma once
#include "core/session/saved_scan.h"

namespace scantrove::test {

/// Adds three tracked frames, each of them a key frame.
inline void addThreeKeyFrames(SavedDelta& delta) {
  for (int number = 0; number < 3; ++number) {
    SavedFrame frame;
    frame.number = number;
    frame.state = TrackingState::tracking;
    delta.frames.push_back(frame);
    SavedKeyFrame key;
    key.frame = number;
    delta.key_frames.push_back(key);
  }
}

}  // namespace scantrove::test
