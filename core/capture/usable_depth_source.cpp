#include "core/capture/usable_depth_source.h"

#include "core/capture/usable_depth.h"

namespace scantrove {
namespace {

FrameRead withUsableDepth(FrameRead read) {
  RgbdFrame& frame = read.frame;
  if (frame.confidence.empty()) return read;
  frame.depth = usableDepth(frame);
  frame.confidence.release();
  return read;
}

}  // namespace

FrameRead UsableDepthSource::next() { return withUsableDepth(source_->next()); }

std::optional<FrameRead> UsableDepthSource::nextIfReady() {
  std::optional<FrameRead> read = source_->nextIfReady();
  if (!read) return read;
  return withUsableDepth(std::move(*read));
}

}  // namespace scantrove
