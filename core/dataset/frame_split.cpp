#include "core/dataset/frame_split.h"

#include <vector>

#include "core/dataset/key_frame_images.h"

namespace scantrove {

Result<FrameSplit> splitFrames(ExportJob& job) {
  constexpr std::size_t kMinForValidation = 5;
  const auto frames = framesToExport(job, true);
  if (!frames) return fail(frames.error());
  const std::size_t count = frames->size();
  const std::size_t training = count < kMinForValidation ? count : count - count / 5;
  FrameSplit split;
  for (std::size_t i = 0; i < training; ++i) split.training.insert((*frames)[i].index);
  split.has_validation = training < count;
  return split;
}

}  // namespace scantrove
