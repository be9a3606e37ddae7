#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scantrove {

/// Run lengths of a mask, column by column, starting with an outside run, which may be 0.
using MaskRuns = std::vector<std::uint32_t>;

/// The runs of a mask (CV_8UC1, nonzero = inside).
[[nodiscard]] MaskRuns runsOf(const cv::Mat& mask);

/// COCO's text of such runs. From the fourth on, each is the difference to the run two before. A letter
/// holds five bits, lowest first, plus 48; the sixth bit is set if more follow, and the fifth of the last
/// one is the sign.
[[nodiscard]] std::string encodeRuns(const MaskRuns& runs);

/// The runs of such a text. None: it has other letters, ends within a run, or a run does not fit into 31
/// bits.
[[nodiscard]] std::optional<MaskRuns> decodeRuns(std::string_view text);

}  // namespace scantrove
