#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace scantrove {

/// Run lengths of a mask (CV_8UC1, nonzero = inside), column by column, starting with an outside run, which
/// may be 0.
[[nodiscard]] std::vector<std::uint32_t> runsOf(const cv::Mat& mask);

/// COCO's text of such runs. From the fourth on, each is the difference to the run two before. A letter
/// holds five bits, lowest first, plus 48; the sixth bit is set if more follow, and the fifth of the last
/// one is the sign.
[[nodiscard]] std::string encodeRuns(const std::vector<std::uint32_t>& runs);

}  // namespace scantrove
