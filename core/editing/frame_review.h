#pragma once
#include "core/base/review_state.h"

namespace scantrove {

/// A person's review of one key frame.
struct FrameReview {
  int key_frame = -1;  ///< SavedFrame::number; negative: unknown
  int image = 0;       ///< number of the frame in its source, as shown to users
  ReviewState state = ReviewState::open;

  bool operator==(const FrameReview&) const = default;
};

}  // namespace scantrove
