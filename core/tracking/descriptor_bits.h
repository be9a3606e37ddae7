#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace scantrove {

/// The 256 bits by which a feature is known (ORB).
using Descriptor = std::array<std::uint64_t, 4>;

/// Of rows as ColorView and Landmarks have them: CV_8UC1, 32 bytes each.
[[nodiscard]] std::vector<Descriptor> descriptorsOf(const cv::Mat& rows);

/// How many bits of `one` differ from each of the others. `bits` has room for as many. Any thread.
void countDifferentBits(const Descriptor& one, std::span<const Descriptor> others, std::span<int> bits);

}  // namespace scantrove
