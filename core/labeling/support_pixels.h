#pragma once

namespace scantrove {

/// How often something was seen as a support or on one (SegmentRole): numbers of pixels in an image of
/// 320 x 240, over all frames.
struct SupportPixels {
  float seen = 0;     ///< whatever its role
  float support = 0;  ///< in a support
  float carried = 0;  ///< in something that lies on a support

  /// Whether it is a support itself rather than an object that sometimes carries another one.
  [[nodiscard]] bool isSupport() const {
    constexpr float kEnough = 2000, kMostly = 0.6F;
    return seen >= kEnough && support > kMostly * seen;
  }

  SupportPixels& operator+=(const SupportPixels& other) {
    seen += other.seen;
    support += other.support;
    carried += other.carried;
    return *this;
  }
  bool operator==(const SupportPixels&) const = default;
};

}  // namespace scantrove
