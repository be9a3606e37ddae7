#include "ui/models/key_frame_reviews.h"

#include <utility>

namespace scantrove {

bool passes(ReviewState state, ReviewFilter filter) {
  switch (filter) {
    case ReviewFilter::all:
      return true;
    case ReviewFilter::open:
      return state == ReviewState::open;
    case ReviewFilter::checked:
      return state == ReviewState::checked;
  }
  return true;
}

void KeyFrameReviews::update(const ScanSnapshot& snapshot) {
  std::vector<FrameReview> reviews;
  if (snapshot.reviews != nullptr) {
    reviews = *snapshot.reviews;
  } else if (snapshot.key_frames != nullptr) {
    for (const int image : *snapshot.key_frames) reviews.push_back({.image = image});
  }
  if (reviews == reviews_) return;
  reviews_ = std::move(reviews);
  emit changed();
}

void KeyFrameReviews::clear() {
  reviews_.clear();
  emit changed();
}

void KeyFrameReviews::set(int index, ReviewState state) {
  if (at(index) == nullptr) return;
  reviews_[static_cast<std::size_t>(index)].state = state;
  emit changed();
}

const FrameReview* KeyFrameReviews::at(int index) const {
  return index >= 0 && index < static_cast<int>(reviews_.size()) ? &reviews_[static_cast<std::size_t>(index)]
                                                                 : nullptr;
}

ReviewCounts KeyFrameReviews::counts() const {
  ReviewCounts counts;
  for (const FrameReview& review : reviews_) counts.add(review.state);
  return counts;
}

int KeyFrameReviews::next(int from, int step, ReviewFilter filter) const {
  const auto count = static_cast<int>(reviews_.size());
  const int direction = step < 0 ? -1 : 1;
  for (int i = 1; i < count; ++i) {
    const int index = ((from + direction * i) % count + count) % count;
    if (passes(reviews_[static_cast<std::size_t>(index)].state, filter)) return index;
  }
  return -1;
}

}  // namespace scantrove
