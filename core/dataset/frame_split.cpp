#include "core/dataset/frame_split.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/dataset/key_frame_images.h"

namespace scantrove {

Result<FrameSplit> splitFrames(ExportJob& job) {
  FrameSplit split;
  split.whole = job.part().split.value_or(DatasetSplit::train);
  if (job.scans().isProject()) return split;
  const auto frames = framesToExport(job, true);
  if (!frames) return fail(frames.error());
  const std::size_t count = frames->size();
  constexpr double kRounding = 1e-9;  // a fifth of five frames is one frame
  const double share = std::clamp(job.options().choices.validation_share, 0.0, 1.0);
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(count) + kRounding);
  const std::size_t validation = std::min(wanted, count - std::min<std::size_t>(count, 1));
  for (std::size_t i = count - validation; i < count; ++i) split.validation.insert((*frames)[i].index);
  return split;
}

}  // namespace scantrove
