#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace scantrove {

/// Lengths of the runs of a mask (CV_8UC1, not 0 = inside), column by column, outside first (that run may be
/// 0).
[[nodiscard]] std::vector<std::uint32_t> runsOf(const cv::Mat& mask);

/// COCO's text of such runs: from the fourth on as differences to the run two before, then five bits a letter
/// from the lowest on, the sixth bit set if more follow, the fifth of the last one as the sign; 48 is added
/// to each.
[[nodiscard]] std::string encodeRuns(const std::vector<std::uint32_t>& runs);

}  // namespace scantrove
