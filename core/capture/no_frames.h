#pragma once
#include <utility>

#include "core/capture/frame_source.h"

namespace scantrove {

/// A source that is at its end from the start: it only describes its camera.
class NoFrames final : public FrameSource {
 public:
  explicit NoFrames(SourceInfo info) : info_(std::move(info)) {}
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override { return {}; }

 private:
  SourceInfo info_;
};

}  // namespace scantrove
