#pragma once
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Reads another source on its own thread, so that decoding overlaps with processing of the previous frame. A
/// recording loses nothing: its thread waits when the queue is full. A live source keeps only the newest
/// frame and counts the others in FrameRead::dropped. An exception from the source becomes
/// FrameRead::Status::failed.
class ReadAhead final : public FrameSource {
 public:
  static constexpr std::size_t kCapacity = 4;

  /// `live_limit`: a live source ends after next() returned this many frames; dropped ones do not count.
  explicit ReadAhead(std::unique_ptr<FrameSource> source, std::size_t capacity = kCapacity,
                     std::optional<int> live_limit = {});
  ~ReadAhead() override;
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  /// Waits for the next frame; for that of a live source a second at most (timeout). After end, failed or
  /// cancel(), returns that status (end) again without waiting.
  [[nodiscard]] FrameRead next() override;
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override;

  /// Any thread: makes a waiting next() return `end`, and stops reading after the current frame.
  void cancel();

 private:
  /// Pops queue_, which is not empty; mutex_ is held.
  [[nodiscard]] FrameRead takeFirst();
  void readAll(const std::stop_token& stop);
  void postRecorded(FrameRead read, const std::stop_token& stop);
  void postLive(FrameRead read);

  std::unique_ptr<FrameSource> source_;
  SourceInfo info_;
  std::size_t capacity_;
  std::optional<int> live_limit_;

  std::mutex mutex_;  // guards the fields below
  std::condition_variable_any changed_;
  std::deque<FrameRead> queue_;
  int taken_ = 0;  // frames returned from a live source
  bool is_cancelled_ = false;
  bool is_over_ = false;  // next() has returned end or failed, or reached the limit

  std::jthread thread_;  // last field: joined before the others are destroyed
};

}  // namespace scantrove
