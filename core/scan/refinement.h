#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/scan/frame_objects.h"
#include "core/scan/session_recorder.h"

namespace scantrove {

class ScanPipeline;

/// How far a refinement has come.
struct RefinementPosition {
  enum class Pass { segment, rate, judge, collect, complete, done };
  Pass pass = Pass::segment;
  int frames = 0;  ///< of this pass that are done

  bool operator==(const RefinementPosition&) const = default;
};

/// The final pass over the key frames of a scan: segments them at full resolution, rates which regions are
/// complete objects, drops views and objects that show something else, and collects what was missed. It can
/// be stopped at any frame and continued from there later. One thread, the worker's.
class Refinement {
 public:
  using KeyFrames = std::vector<SessionRecorder::StoredFrame>;
  struct Callbacks {
    std::function<bool()> may_continue;  ///< asked before each frame
    std::function<void(int done, int steps)> progress;
    std::function<void(const FrameObjects&)> collected;
  };

  /// Of more key frames only so many are used, evenly spread. One takes as long as six frames of the scan.
  static constexpr std::size_t kMaxKeyFrames = 180;

  /// `folder`: of the session. `pipeline` outlives the refinement.
  Refinement(ScanPipeline& pipeline, std::filesystem::path folder, KeyFrames key_frames, Callbacks callbacks);

  /// Refines from `begin` to the end, or until `may_continue` says false. Error: the device failed.
  [[nodiscard]] Result<void> run(RefinementPosition begin);
  /// Where run() stopped.
  [[nodiscard]] RefinementPosition position() const { return position_; }
  [[nodiscard]] int keyFrames() const { return static_cast<int>(key_frames_.size()); }

 private:
  using Pass = RefinementPosition::Pass;
  /// One frame of a pass.
  struct Task {
    int frame_index = 0;                                ///< RgbdFrame::index
    const SessionRecorder::StoredFrame* key = nullptr;  ///< null: its images are not needed
  };

  [[nodiscard]] Result<std::vector<Task>> beginPass(bool is_first);
  [[nodiscard]] Result<void> doTask(const Task& task);
  [[nodiscard]] Result<void> endPass();
  [[nodiscard]] std::vector<Task> allKeyFrames() const;
  /// Of the progress.
  [[nodiscard]] int stepsOf(Pass pass) const;
  void reportProgress(std::size_t tasks) const;

  ScanPipeline& pipeline_;
  std::filesystem::path folder_;
  KeyFrames key_frames_;
  Callbacks callbacks_;
  RefinementPosition position_;
};

}  // namespace scantrove
