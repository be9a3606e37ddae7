#include "core/capture/rest_of_source.h"

#include <algorithm>
#include <utility>

namespace scantrove {

RestOfSource::RestOfSource(std::unique_ptr<FrameSource> source, int last_index, int read)
    : source_(std::move(source)), info_(source_->info()), last_index_(last_index) {
  if (info_.frame_count) info_.frame_count = std::max(0, *info_.frame_count - read);
}

std::optional<FrameRead> RestOfSource::nextIfReady() {
  std::optional<FrameRead> read = source_->nextIfReady();
  if (!read) return read;
  return ofTheRest(std::move(*read));
}

FrameRead RestOfSource::ofTheRest(FrameRead read) {
  const bool is_frame = read.status == FrameRead::Status::frame;
  has_begun_ = has_begun_ || (is_frame && read.frame.index > last_index_);
  if (has_begun_ || (!is_frame && read.status != FrameRead::Status::skipped)) return read;
  FrameRead left_out;
  left_out.status = FrameRead::Status::timeout;
  return left_out;
}

}  // namespace scantrove
