#pragma once
#include <memory>
#include <optional>

#include "core/capture/frame_source.h"

namespace scantrove {

/// A recording without the frames up to `last_index`, which a scan has read before. A frame that is left out
/// is read as a timeout, so that a scan can be stopped meanwhile.
class RestOfSource final : public FrameSource {
 public:
  /// `read`: the number of frames that are left out, for the length of the recording.
  RestOfSource(std::unique_ptr<FrameSource> source, int last_index, int read);

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override { return ofTheRest(source_->next()); }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override;

 private:
  [[nodiscard]] FrameRead ofTheRest(FrameRead read);

  std::unique_ptr<FrameSource> source_;
  SourceInfo info_;
  int last_index_;
  bool has_begun_ = false;  // a frame of the rest was read
};

}  // namespace scantrove
