#pragma once
#include <memory>
#include <optional>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Another recording as the next part of a scan. Shifts frame numbers and times to follow the scan's last
/// ones. A recording that is already later, such as the rest of the same one, keeps its own.
class ContinuedSource final : public FrameSource {
 public:
  /// Added to a frame's index and time in the recording.
  struct Shift {
    int index = 0;
    double time_s = 0;
  };

  /// `last_index` and `last_time_s`: the largest values of the scan so far. `intrinsics`: for frames without
  /// their own, if the scan has others.
  ContinuedSource(std::unique_ptr<FrameSource> source, int last_index, double last_time_s,
                  const std::optional<Intrinsics>& intrinsics = {})
      : source_(std::move(source)),
        last_index_(last_index),
        last_time_s_(last_time_s),
        intrinsics_(intrinsics) {}

  [[nodiscard]] const SourceInfo& info() const override { return source_->info(); }
  [[nodiscard]] FrameRead next() override { return shifted(source_->next()); }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override;

  /// Zero before the first frame.
  [[nodiscard]] Shift shift() const { return shift_.value_or(Shift{}); }

 private:
  [[nodiscard]] FrameRead shifted(FrameRead read);

  std::unique_ptr<FrameSource> source_;
  int last_index_;
  double last_time_s_;
  std::optional<Intrinsics> intrinsics_;
  std::optional<Shift> shift_;  // the first frame decides
};

}  // namespace scantrove
