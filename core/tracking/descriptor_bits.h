#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace scantrove {

/// The 256 bits that describe a feature (ORB).
using Descriptor = std::array<std::uint64_t, 4>;

/// Converts rows of ColorView or Landmarks: CV_8UC1, 32 bytes each.
[[nodiscard]] std::vector<Descriptor> descriptorsOf(const cv::Mat& rows);

/// Counts the bits of `one` that differ from each of `others`; `bits` has at least as many elements. Any
/// thread.
void countDifferentBits(const Descriptor& one, std::span<const Descriptor> others, std::span<int> bits);

}  // namespace scantrove
