#pragma once
#include <utility>

#include "core/capture/frame_source.h"

namespace scantrove {

/// The source of a session without new frames: it provides the camera, and is at its end.
class NoFrames final : public FrameSource {
 public:
  explicit NoFrames(SourceInfo info) : info_(std::move(info)) {}
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override { return {}; }

 private:
  SourceInfo info_;
};

}  // namespace scantrove
