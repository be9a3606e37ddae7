#include "core/scan/refinement.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/scan/key_frame_files.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {
namespace {

/// At most so many of them, as far apart in the list as can be.
template <class T>
std::vector<T> evenly(std::vector<T> all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(std::move(all[i * all.size() / most]));
  return chosen;
}

constexpr std::array kPasses{RefinementPosition::Pass::segment, RefinementPosition::Pass::rate,
                             RefinementPosition::Pass::judge, RefinementPosition::Pass::collect,
                             RefinementPosition::Pass::complete};

RefinementPosition::Pass after(RefinementPosition::Pass pass) {
  return static_cast<RefinementPosition::Pass>(static_cast<int>(pass) + 1);
}

}  // namespace

Refinement::Refinement(ScanPipeline& pipeline, std::filesystem::path folder, KeyFrames key_frames,
                       Callbacks callbacks)
    : pipeline_(pipeline),
      folder_(std::move(folder)),
      key_frames_(evenly(std::move(key_frames), kMaxKeyFrames)),
      callbacks_(std::move(callbacks)) {}

Result<void> Refinement::run(RefinementPosition begin) {
  position_ = begin;
  // Ratings are not kept: they count together.
  if (position_.pass == Pass::rate) position_.frames = 0;
  for (bool is_first = true; position_.pass != Pass::done; is_first = false) {
    if (!callbacks_.may_continue()) return {};  // a pass may begin by reading the whole map
    const Result<std::vector<Task>> tasks = beginPass(is_first);
    if (!tasks) return fail(tasks.error());
    for (std::size_t i = static_cast<std::size_t>(position_.frames); i < tasks->size(); ++i) {
      if (!callbacks_.may_continue()) return {};
      reportProgress(tasks->size());
      SCANTROVE_TRY(doTask((*tasks)[i]));
      ++position_.frames;
    }
    SCANTROVE_TRY(endPass());
    position_ = {after(position_.pass), 0};
  }
  return {};
}

Result<std::vector<Refinement::Task>> Refinement::beginPass(bool is_first) {
  const bool has_judge = !is_first || position_.pass <= Pass::rate;
  if (!has_judge) SCANTROVE_TRY(pipeline_.resumeLookingAgain());
  if (position_.pass == Pass::rate) SCANTROVE_TRY(pipeline_.beginLookingAgain());
  std::vector<Task> tasks;
  if (position_.pass == Pass::judge) {
    for (const int frame_index : pipeline_.framesOfViews()) tasks.push_back({frame_index, nullptr});
    return tasks;
  }
  tasks = allKeyFrames();
  if (position_.pass != Pass::complete) return tasks;
  const std::vector<int> needed = pipeline_.beginLastLooks();
  std::erase_if(tasks,
                [&](const Task& task) { return !std::ranges::binary_search(needed, task.frame_index); });
  return tasks;
}

std::vector<Refinement::Task> Refinement::allKeyFrames() const {
  std::vector<Task> tasks;
  for (const SessionRecorder::StoredFrame& key : key_frames_) tasks.push_back({key.frame.source_index, &key});
  return tasks;
}

Result<void> Refinement::doTask(const Task& task) {
  if (task.key == nullptr) return pipeline_.judgeViewsOf(task.frame_index);
  const Result<RgbdFrame> frame = readKeyFrame(folder_, task.key->images, task.key->frame);
  if (!frame) return {};  // whoever opens the key frame is told
  const Eigen::Isometry3d& T_world_camera = task.key->frame.T_world_camera;
  if (position_.pass == Pass::segment) return pipeline_.segmentCloser(*frame, T_world_camera);
  if (position_.pass == Pass::rate) return pipeline_.rate(*frame, T_world_camera);
  const Result<FrameObjects> objects = pipeline_.lookAgain(*frame, T_world_camera);
  if (!objects) return fail(objects.error());
  callbacks_.collected(*objects);
  return {};
}

Result<void> Refinement::endPass() {
  if (position_.pass == Pass::rate) return pipeline_.settleWholes();
  if (position_.pass == Pass::complete) pipeline_.endLookingAgain();
  return {};
}

int Refinement::stepsOf(Pass pass) const {
  const bool is_short = pass == Pass::judge || pass == Pass::complete;
  return is_short ? (keyFrames() + 3) / 4 : keyFrames();
}

/// The number of tasks in a pass is known when it begins, its part of all steps before.
void Refinement::reportProgress(std::size_t tasks) const {
  int done = 0, all = 0;
  for (const Pass pass : kPasses) {
    all += stepsOf(pass);
    if (pass < position_.pass) done += stepsOf(pass);
  }
  done += stepsOf(position_.pass) * position_.frames / static_cast<int>(tasks);
  callbacks_.progress(done, all);
}

}  // namespace scantrove
