#pragma once
#include <algorithm>

namespace scantrove {

/// Whether the frames of a recording have colour, if single ones may have none. After a long stretch without,
/// it counts as one without colour.
class ColorPresence {
 public:
  /// Frames; devices store at least every tenth colour image.
  static constexpr int kLongestGap = 30;

  /// Whether other frames around the last one have colour.
  [[nodiscard]] bool isExpected() const { return frames_without_ < kLongestGap; }
  /// Adds a frame. True: it is the first one with colour, or the first after a long stretch without.
  bool add(bool has_color) {
    const bool is_first = has_color && !isExpected();
    frames_without_ = has_color ? 0 : std::min(frames_without_ + 1, kLongestGap);
    return is_first;
  }

 private:
  int frames_without_ = kLongestGap;
};

}  // namespace scantrove
