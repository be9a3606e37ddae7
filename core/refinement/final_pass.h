#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/collection/object_collector.h"
#include "core/discovery/region_judge.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/refinement/refinement_position.h"

namespace scantrove {

/// The refinement of a scan: segments its key frames at full resolution, rates which regions are complete
/// objects, drops views and objects that show something else, collects what was missed, and chooses the best
/// views of each object. It can be stopped at any frame and continued from there later. One thread, the
/// worker's.
class FinalPass {
 public:
  struct KeyFrame {
    int frame_index = 0;  ///< RgbdFrame::index
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    std::function<Result<RgbdFrame>()> read;  ///< from disk
  };
  struct Callbacks {
    std::function<bool()> may_continue;  ///< asked before each frame
    std::function<void(int done, int steps)> progress;
    std::function<void(const FrameObjects&)> collected;
  };

  /// Maximum number of key frames, evenly selected. One takes as long as six frames of the scan.
  static constexpr std::size_t kMaxKeyFrames = 180;

  /// `pipeline` and `collector` outlive this. Unreadable key frames are skipped.
  FinalPass(MappingPipeline& pipeline, ObjectCollector& collector, std::vector<KeyFrame> key_frames,
            Callbacks callbacks);

  /// Refines from `begin` to the end, or until `may_continue` returns false. Error: the device failed.
  [[nodiscard]] Result<void> run(RefinementPosition begin);
  /// The position where run() stopped.
  [[nodiscard]] RefinementPosition position() const { return position_; }
  /// The objectness of the regions (RatedSets::ofRegions); none: this run has not rated them to the end.
  [[nodiscard]] const std::optional<std::map<RegionId, float>>& objectness() const { return objectness_; }
  [[nodiscard]] int keyFrames() const { return static_cast<int>(key_frames_.size()); }

 private:
  using Pass = RefinementPosition::Pass;
  using FrameStep = std::function<Result<void>(const RgbdFrame&, const Eigen::Isometry3d& T_world_camera)>;

  // One pass each. False: stopped before its end.
  [[nodiscard]] Result<bool> segment();
  [[nodiscard]] Result<bool> rate();
  [[nodiscard]] Result<bool> judgeViews();
  [[nodiscard]] Result<bool> collect();
  [[nodiscard]] Result<bool> complete();
  [[nodiscard]] Result<bool> compareViews();
  [[nodiscard]] Result<bool> storeViews();
  [[nodiscard]] Result<bool> runPass();

  /// Runs a pass for each of its remaining frames.
  template <class Task>
  [[nodiscard]] Result<bool> forEach(const std::vector<Task>& tasks,
                                     const std::function<Result<void>(const Task&)>& step);
  [[nodiscard]] Result<bool> forEachKeyFrame(const std::vector<const KeyFrame*>& keys, const FrameStep& step);
  [[nodiscard]] std::vector<const KeyFrame*> allKeyFrames() const;
  /// Those of these frames (RgbdFrame::index), ascending.
  [[nodiscard]] std::vector<const KeyFrame*> keyFramesOf(const std::vector<int>& frames) const;
  /// The frame's candidates as rated by `judge`.
  [[nodiscard]] std::vector<Candidate> findCandidates(FrameResult& observed, RegionJudge& judge,
                                                      const RegionTable& table);
  [[nodiscard]] Result<void> collectFrom(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);
  /// Calls `use` with each object as the frame shows it, unless a user marked its regions as none.
  [[nodiscard]] Result<void> forEachObjectIn(
      const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
      const std::function<void(const Candidate&, const ObservedFrame&)>& use);
  [[nodiscard]] Result<void> judgeViewsOf(int frame_index);
  /// A judge of the current regions.
  [[nodiscard]] Result<std::unique_ptr<RegionJudge>> makeJudge(const RegionTable& table);
  /// For the progress.
  [[nodiscard]] int stepsOf(Pass pass) const;
  void reportProgress(std::size_t tasks) const;

  MappingPipeline& pipeline_;
  ObjectCollector& collector_;
  std::vector<KeyFrame> key_frames_;
  Callbacks callbacks_;
  RefinementPosition position_;
  std::unique_ptr<RegionJudge> judge_;  // for the settled regions
  std::optional<std::map<RegionId, float>> objectness_;
};

}  // namespace scantrove
