#pragma once
#include <optional>
#include <string_view>

namespace scantrove {

/// Whether a person has checked the labels of a key frame.
enum class ReviewState {
  open,     ///< not yet
  checked,  ///< they are right
  left_out  ///< the frame is in no data set
};

/// "open", "checked", "left-out".
[[nodiscard]] std::string_view toString(ReviewState state);
/// None: no such state.
[[nodiscard]] std::optional<ReviewState> reviewStateOf(std::string_view text);

/// Numbers of key frames in each state.
struct ReviewCounts {
  int open = 0, checked = 0, left_out = 0;

  /// Those that need no review any more.
  [[nodiscard]] int reviewed() const { return checked + left_out; }
  [[nodiscard]] int all() const { return open + checked + left_out; }
  void add(ReviewState state, int frames = 1);
  bool operator==(const ReviewCounts&) const = default;
};

}  // namespace scantrove
