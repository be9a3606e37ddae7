// What ScanRun does when its frames have ended and it looks at those that are kept once more.
#include <algorithm>
#include <functional>
#include <utility>

#include "core/scan/key_frame_files.h"
#include "core/scan/scan_run.h"

namespace scantrove {
namespace {

/// Looking at one three times takes about as long as six frames of the scan.
constexpr std::size_t kMostFramesAgain = 180;

/// At most so many of them, as far apart in the list as can be.
template <class T>
std::vector<T> evenly(std::vector<T> all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(std::move(all[i * all.size() / most]));
  return chosen;
}

/// How far passes over the frames are. How many looks a pass has may be known only when it begins, how many
/// steps of all it counts for is known before.
class PassProgress {
 public:
  PassProgress(int steps, std::function<void(const LookingAgain&)> tell)
      : steps_(steps), tell_(std::move(tell)) {}

  void beginPass(int steps, std::size_t looks) {
    before_ += of_pass_;
    of_pass_ = steps;
    looks_ = static_cast<int>(looks);
    look_ = 0;
  }
  void beginLook() { tell_({before_ + of_pass_ * look_++ / looks_, steps_}); }

 private:
  int steps_, before_ = 0, of_pass_ = 0;
  int looks_ = 0, look_ = 0;  // of the pass
  std::function<void(const LookingAgain&)> tell_;
};

}  // namespace

Result<void> ScanRun::lookAgain(const std::function<bool()>& goes_on) {
  if (!recorder_ || pipeline_->collector() == nullptr || !hasFrames()) return {};
  SCANTROVE_TRY(recorder_->save(*pipeline_));
  auto all = recorder_->keptFrames();
  if (!all) return fail(all.error());
  const std::vector<SessionRecorder::KeptFrame> frames = evenly(std::move(*all), kMostFramesAgain);
  const auto all_frames = static_cast<int>(frames.size());
  const int short_pass = (all_frames + 3) / 4;
  PassProgress progress(3 * all_frames + 2 * short_pass, listener_);
  const auto readAgain = [&](const SessionRecorder::KeptFrame& kept) {
    progress.beginLook();
    return readKeyFrame(recorder_->folder(), kept.images, kept.frame);
  };
  progress.beginPass(all_frames, frames.size());
  for (const SessionRecorder::KeptFrame& kept : frames) {
    if (!goes_on()) return {};
    const Result<RgbdFrame> frame = readAgain(kept);
    if (frame) SCANTROVE_TRY(pipeline_->segmentCloser(*frame, kept.frame.T_world_camera));
  }
  if (!goes_on()) return {};  // it begins by reading the whole map
  SCANTROVE_TRY(pipeline_->beginLookingAgain());
  // What is settled after a part of the looks is settled wrongly: who stops before keeps what there was.
  progress.beginPass(all_frames, frames.size());
  for (const SessionRecorder::KeptFrame& kept : frames) {
    if (!goes_on()) return {};
    const Result<RgbdFrame> frame = readAgain(kept);
    if (frame) SCANTROVE_TRY(pipeline_->rate(*frame, kept.frame.T_world_camera));
  }
  const Result<std::vector<int>> judged = pipeline_->settleWholes();
  if (!judged) return fail(judged.error());
  progress.beginPass(short_pass, judged->size());
  for (const int frame_index : *judged) {
    if (!goes_on()) return {};
    progress.beginLook();
    SCANTROVE_TRY(pipeline_->judgeViewsOf(frame_index));
  }
  const auto lookAt = [&](const SessionRecorder::KeptFrame& kept) -> Result<void> {
    const Result<RgbdFrame> frame = readAgain(kept);
    if (!frame) return {};  // who looks at it is told
    const Result<FrameObjects> objects = pipeline_->lookAgain(*frame, kept.frame.T_world_camera);
    if (!objects) return fail(objects.error());
    announce(*objects);
    return {};
  };
  progress.beginPass(all_frames, frames.size());
  for (const SessionRecorder::KeptFrame& frame : frames) {
    if (!goes_on()) break;
    SCANTROVE_TRY(lookAt(frame));
  }
  const std::vector<int> last = pipeline_->beginLastLooks();
  progress.beginPass(short_pass, last.size());
  for (const SessionRecorder::KeptFrame& frame : frames) {
    if (!std::ranges::binary_search(last, frame.frame.source_index)) continue;
    if (!goes_on()) break;
    SCANTROVE_TRY(lookAt(frame));
  }
  pipeline_->endLookingAgain();
  return {};
}

}  // namespace scantrove
