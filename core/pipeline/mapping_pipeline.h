#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/stage_timer.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/discovery/candidate_finder.h"
#include "core/editing/region_editor.h"
#include "core/pipeline/camera_continuation.h"
#include "core/pipeline/frame_result.h"
#include "core/pipeline/frame_tracking.h"
#include "core/pipeline/map_fusion.h"
#include "core/pipeline/map_labels.h"
#include "core/pipeline/map_readout.h"
#include "core/pipeline/mapping_params.h"
#include "core/segmentation/graph_segmenter.h"
#include "core/segmentation/support_finder.h"

namespace scantrove {

/// Takes a frame through every stage of the thesis up to the candidates for objects. Independent of the
/// catalogue; the cost per frame does not grow with the scan. One thread, the compute context's.
class MappingPipeline {
 public:
  struct Setup {
    Intrinsics K;  ///< of the recording
    MappingParams params;
    PoseUse poses = PoseUse::none;        ///< of RgbdFrame::T_world_camera
    std::optional<int> frame_count = {};  ///< of the recording; empty for a live camera
    double filled_part = 1;               ///< of the images, by surface: PoseTracker::create
  };

  /// `compute` outlives the pipeline. Error: the device has no room for one view of the map, or failed.
  [[nodiscard]] static Result<std::unique_ptr<MappingPipeline>> create(ComputeContext& compute,
                                                                       const Setup& setup);

  using NextFrame = FrameTracking::NextFrame;
  /// Error: the device failed or has no memory left; the scan cannot continue, but the map can still be
  /// read. A lost frame is a value, not an error. If `next` is available, another thread prepares it during
  /// this frame's labelling; results are the same. Stages are in timer(); the caller ends the frame there.
  [[nodiscard]] Result<FrameResult> processFrame(const RgbdFrame& frame, const NextFrame& next = {});

  /// Replaces all parameters but those of fusion, which are fixed for the life of the map.
  void setParams(const MappingParams& params);
  [[nodiscard]] const MappingParams& params() const { return params_; }

  /// Applies a user's operation to the regions, for all later frames. Error: see RegionEditor; or the
  /// device failed. `painted`: see RegionEditor::apply.
  [[nodiscard]] Result<RegionEditor::Outcome> edit(const Operation& operation,
                                                   const PaintedSurface* painted = nullptr);
  /// Undoes the newest operation, or redoes it. Error: there is none.
  [[nodiscard]] Result<RegionEditor::Outcome> undo();
  [[nodiscard]] Result<RegionEditor::Outcome> redo();

  // After a scan.

  /// Segments an earlier frame at full depth resolution and merges it (only by the rule `graph`), which
  /// separates structures as narrow as a book spine. Error: the device failed.
  [[nodiscard]] Result<RegionEvents> segmentCloser(const RgbdFrame& frame,
                                                   const Eigen::Isometry3d& T_world_camera);
  /// The map and an earlier frame from its pose, with the current regions and the pixels of the frame's
  /// depth image, at most twice the working resolution. May throw cl::Error.
  [[nodiscard]] FrameResult observe(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);
  /// Finds candidates for objects in it, with the regions of `table`.
  void findCandidates(CandidateSource& finder, const RegionTable& table, FrameResult& observed) const;
  /// Tells discovery about changes of regions by others.
  void applyRegionEvents(const RegionEvents& events);

  /// Segments the last frame again with the current parameters (empty without a pose), or a view of the
  /// map. Neither changes map or labels. Error: the device failed.
  [[nodiscard]] Result<SegmentMap> segmentAgain();
  [[nodiscard]] Result<SegmentMap> segmentMapFrom(const Eigen::Isometry3d& T_world_camera,
                                                  const Intrinsics& K, const SegmentationParams& params);

  [[nodiscard]] const MapLabels& labels() const { return *labels_; }
  [[nodiscard]] MapLabels& labels() { return *labels_; }
  [[nodiscard]] const BrickMap& bricks() const { return fusion_->bricks(); }
  [[nodiscard]] BrickMap& bricks() { return fusion_->bricks(); }
  [[nodiscard]] MapReadout& readout() { return *readout_; }
  [[nodiscard]] CameraContinuation& camera() { return *camera_; }
  [[nodiscard]] const StageTimer& timer() const { return timer_; }
  [[nodiscard]] StageTimer& timer() { return timer_; }
  /// Of the working view of the last frame.
  [[nodiscard]] const Intrinsics& workingIntrinsics() const { return tracking_->intrinsics(); }
  /// Of that of a frame with this RgbdFrame::intrinsics; none: of a frame with the recording's. All have one
  /// size.
  [[nodiscard]] Intrinsics workingIntrinsicsOf(const std::optional<Intrinsics>& of_frame) const {
    return tracking_->intrinsicsOf(of_frame);
  }
  /// Bricks whose labels the last frame may have changed.
  [[nodiscard]] std::span<const Eigen::Vector3i> touchedBricks() const { return touched_; }

 private:
  MappingPipeline(ComputeContext& compute, const Setup& setup)
      : compute_(compute), params_(setup.params), frame_count_(setup.frame_count) {}

  /// The supports of a frame. None for the thesis' rule, which takes segments as they are.
  [[nodiscard]] std::vector<Support> supportsOf(const SegmentMap& segments, const Intrinsics& K) const;
  [[nodiscard]] FrameResult runStages(const RgbdFrame& frame, const NextFrame& next);
  void findCandidates(CandidateSource& finder, const RegionTable& table,
                      std::span<const std::uint8_t> newly_appeared, FrameResult& result) const;
  [[nodiscard]] Result<RegionEditor::Outcome> applied(Result<RegionEditor::Outcome> outcome);
  [[nodiscard]] Intrinsics closeCamera(const RgbdFrame& frame) const;
  [[nodiscard]] Error outOfMemory(int frame_index) const;

  ComputeContext& compute_;
  MappingParams params_;
  std::optional<int> frame_count_;
  StageTimer timer_;

  std::unique_ptr<MapFusion> fusion_;
  std::unique_ptr<GraphSegmenter> segmenter_;
  std::unique_ptr<MapLabels> labels_;
  std::unique_ptr<CandidateFinder> finder_;
  std::unique_ptr<FrameTracking> tracking_;  // uses fusion_ on another thread, so it is destroyed first
  std::optional<MapReadout> readout_;
  std::optional<CameraContinuation> camera_;

  bool has_pose_ = false;  // the surface of fusion_ belongs to the last frame
  std::span<const Eigen::Vector3i> touched_;
  std::vector<Eigen::Vector3f> color_lab_;  // of the last frame with a pose
  int frames_ = 0;                          // given to processFrame
  SurfaceMaps observed_;                    // the last view of observe()
};

}  // namespace scantrove
