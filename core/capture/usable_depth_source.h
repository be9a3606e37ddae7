#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Another source with usableDepth() in place of depth and confidence, so that tracking, fusion, stored key
/// frames and label images all have the same readings.
class UsableDepthSource final : public FrameSource {
 public:
  explicit UsableDepthSource(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  [[nodiscard]] const SourceInfo& info() const override { return source_->info(); }
  [[nodiscard]] FrameRead next() override;
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override;

 private:
  std::unique_ptr<FrameSource> source_;
};

}  // namespace scantrove
