#include "core/editing/frame_review_states.h"

namespace scantrove {

std::map<int, ReviewState> reviewStatesOf(const OperationLog& log) {
  std::map<int, ReviewState> states;
  for (const OperationLog::Entry& entry : log.entries()) {
    const std::optional<FrameReview>& review = entry.operation.review;
    if (entry.state == OperationLog::State::done && review && review->key_frame >= 0)
      states[review->key_frame] = review->state;
  }
  return states;
}

ReviewState stateIn(const std::map<int, ReviewState>& states, int key_frame) {
  const auto found = states.find(key_frame);
  return found == states.end() ? ReviewState::open : found->second;
}

}  // namespace scantrove
