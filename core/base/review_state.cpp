#include "core/base/review_state.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scantrove {
namespace {

constexpr std::array<std::pair<ReviewState, std::string_view>, 3> kReviewStates{
    {{ReviewState::open, "open"}, {ReviewState::checked, "checked"}, {ReviewState::left_out, "left-out"}}};

}  // namespace

std::string_view toString(ReviewState state) {
  return std::ranges::find(kReviewStates, state, &std::pair<ReviewState, std::string_view>::first)->second;
}

std::optional<ReviewState> reviewStateOf(std::string_view text) {
  const auto found =
      std::ranges::find(kReviewStates, text, &std::pair<ReviewState, std::string_view>::second);
  return found == kReviewStates.end() ? std::nullopt : std::optional(found->first);
}

void ReviewCounts::add(ReviewState state, int frames) {
  switch (state) {
    case ReviewState::open:
      open += frames;
      break;
    case ReviewState::checked:
      checked += frames;
      break;
    case ReviewState::left_out:
      left_out += frames;
      break;
  }
}

}  // namespace scantrove
