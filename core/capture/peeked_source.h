#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Another source, whose first frame can be looked at before next() returns it.
class PeekedSource final : public FrameSource {
 public:
  explicit PeekedSource(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  [[nodiscard]] const SourceInfo& info() const override { return source_->info(); }

  /// What next() will return; waits for it as next() does.
  [[nodiscard]] const FrameRead& peek() {
    if (!peeked_) peeked_ = source_->next();
    return *peeked_;
  }
  [[nodiscard]] FrameRead next() override {
    return peeked_ ? *std::exchange(peeked_, std::nullopt) : source_->next();
  }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override {
    return peeked_ ? std::exchange(peeked_, std::nullopt) : source_->nextIfReady();
  }

 private:
  std::unique_ptr<FrameSource> source_;
  std::optional<FrameRead> peeked_;
};

}  // namespace scantrove
