#pragma once
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/stage_timer.h"
#include "core/capture/color_projection.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/discovery/candidate_finder.h"
#include "core/discovery/region_samples.h"
#include "core/editing/region_editor.h"
#include "core/fusion/color_integrator.h"
#include "core/fusion/dense_map.h"
#include "core/fusion/depth_preprocessor.h"
#include "core/fusion/motion_filter.h"
#include "core/fusion/rendered_view.h"
#include "core/labeling/label_cloud.h"
#include "core/labeling/observation_recorder.h"
#include "core/labeling/region_merger.h"
#include "core/labeling/region_table.h"
#include "core/meshing/mesh_extractor.h"
#include "core/scan/camera_memory.h"
#include "core/scan/editable_cloud.h"
#include "core/scan/finer_regions.h"
#include "core/scan/frame_label_writer.h"
#include "core/scan/frame_result.h"
#include "core/scan/scan_params.h"
#include "core/scan/scan_snapshot.h"
#include "core/segmentation/graph_segmenter.h"
#include "core/tracking/pose_tracker.h"

namespace scantrove {

/// One frame through every stage of the thesis up to the candidates for objects. Owns map, label cloud and
/// region table, and knows no catalogue; cost per frame does not depend on how much was scanned. One thread,
/// the compute context's.
class ScanPipeline {
 public:
  struct Setup {
    Intrinsics K;  ///< of the recording
    ScanParams params;
    bool poses_given = false;             ///< take RgbdFrame::T_world_camera instead of tracking
    std::optional<int> frame_count = {};  ///< of the recording; empty for a live camera
  };

  /// `compute` outlives the pipeline.
  [[nodiscard]] static Result<std::unique_ptr<ScanPipeline>> create(ComputeContext& compute,
                                                                    const Setup& setup);

  /// The frame that processFrame() is given next, if it is there already; asked for once, on this thread.
  using NextFrame = std::function<std::optional<RgbdFrame>()>;
  /// Error: the device failed or has no memory left; the scan cannot go on, but what there is can be read
  /// out. A lost frame is a value, not an error. What is known of `next` by then is found out beside this
  /// frame's labelling, on another thread; results are the same. Its stages are in timer(); the caller ends
  /// the frame there.
  [[nodiscard]] Result<FrameResult> processFrame(const RgbdFrame& frame, const NextFrame& next = {});

  /// Replaces all parameters but those of fusion, which are fixed for the life of the map.
  void setParams(const ScanParams& params);
  [[nodiscard]] const ScanParams& params() const { return params_; }

  /// Does to the regions what a person says; it holds for the frames that follow. Error: see RegionEditor; or
  /// the device failed.
  [[nodiscard]] Result<RegionEditor::Outcome> edit(const Operation& operation);
  /// Takes the newest operation back, or does it again. Error: there is none.
  [[nodiscard]] Result<RegionEditor::Outcome> undo();
  [[nodiscard]] Result<RegionEditor::Outcome> redo();
  [[nodiscard]] const RegionEditor& editor() const { return *editor_; }
  /// Bricks whose labels operations changed since the last call.
  [[nodiscard]] std::vector<Eigen::Vector3i> takeEditedBricks() { return editable_->takeChanged(); }

  /// What a session keeps, and gives back to a fresh pipeline.
  struct Kept {
    BrickMap& bricks;
    LabelCloud& cloud;
    RegionTable& table;
    RegionMerger& merger;
    RegionEditor& editor;
  };
  [[nodiscard]] Kept kept() { return {map_->bricks(), *cloud_, table_, *merger_, *editor_}; }
  /// What the camera of a scan that goes on in this map is followed by. None before the first usable frame.
  /// May throw cl::Error.
  [[nodiscard]] std::optional<CameraMemory> cameraMemory();
  /// The map's last frame was that one's. False: it does not tell enough. May throw cl::Error.
  [[nodiscard]] bool restoreState(CameraMemory memory);

  /// Of a scan that broke off, frame by frame: the camera of this map was there; those that are not lost, in
  /// order. Whether it found its way by that frame: then relocalizeNear() wants it.
  [[nodiscard]] bool recallPose(const Eigen::Isometry3d& T_world_camera) {
    return tracker_ && tracker_->passBy(T_world_camera);
  }
  /// An earlier frame of this map, taken from there: by it a camera finds its way back. May throw cl::Error.
  void relocalizeNear(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);
  /// The camera is somewhere on the map, perhaps there. May throw cl::Error.
  void resumeAt(const Eigen::Isometry3d& T_world_camera);
  /// Segments an earlier frame at the full resolution of its depth and merges it (by the rule `graph`; else
  /// nothing): that separates structures as narrow as a book spine. Error: the device failed.
  [[nodiscard]] Result<RegionEvents> segmentCloser(const RgbdFrame& frame,
                                                   const Eigen::Isometry3d& T_world_camera);
  /// What the map and an earlier frame show from there, with the regions as they are now and the pixels of
  /// the frame's depth image, at most twice the working ones along each side. May throw cl::Error.
  [[nodiscard]] FrameResult observe(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);
  /// Finds what may be an object in it, with `table` for the regions.
  void findCandidates(CandidateSource& finder, const RegionTable& table, FrameResult& observed) const;
  /// Makes regions of parts of regions: FinerRegions::apply.
  [[nodiscard]] RegionEvents divide(const FinerRegions& finer, std::span<const RegionSet> parts);
  /// Frames neither join nor part a known region; all `regions` of one thing become one region.
  enum class Known { no, yes, one_thing };
  void setKnown(const RegionSet& regions, Known known);

  /// All that the map knows of its regions. Error: the device failed.
  [[nodiscard]] Result<RegionSamples> sampleRegions() { return sampleRegions(table_); }
  /// The same with other regions of the map's fragments.
  [[nodiscard]] Result<RegionSamples> sampleRegions(const RegionTable& table);
  [[nodiscard]] const Intrinsics& workingIntrinsics() const { return working_K_; }
  [[nodiscard]] const StageTimer& timer() const { return timer_; }
  [[nodiscard]] StageTimer& timer() { return timer_; }
  [[nodiscard]] const BrickMap& bricks() const { return map_->bricks(); }
  /// Why a part of the map could not be written to disk, or not be read back, since the last call.
  [[nodiscard]] std::optional<Error> takeMapFailure() { return map_->bricks().takeFailure(); }
  [[nodiscard]] const RegionTable& regionTable() const { return table_; }
  /// Fragments whose region changed since the last call.
  [[nodiscard]] std::vector<RegionChange> takeRegionChanges();
  /// How many voxels hold each fragment, by fragment number.
  [[nodiscard]] const std::vector<cl_int>& voxelsOfFragments() const { return cloud_->voxelsOfFragments(); }
  [[nodiscard]] const RegionMerger& regionMerger() const { return *merger_; }
  [[nodiscard]] std::size_t deviceBytes() const;
  /// What the map shows from `T_world_camera`, with the regions as they are now. Error: the device failed.
  [[nodiscard]] Result<RenderedView> renderView(const Eigen::Isometry3d& T_world_camera) {
    return renderView(T_world_camera, working_K_);
  }
  [[nodiscard]] Result<RenderedView> renderView(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K);
  /// S_t of the last frame anew, by the present parameters; of a frame without a pose: empty. Of what the map
  /// shows from somewhere. Neither changes map or labels. Error: the device failed.
  [[nodiscard]] Result<SegmentMap> segmentAgain();
  [[nodiscard]] Result<SegmentMap> segmentMapFrom(const Eigen::Isometry3d& T_world_camera,
                                                  const SegmentationParams& params);
  struct RegionCount {
    int regions = 0;          ///< of at least kSmallFragmentVoxels voxels
    int small_fragments = 0;  ///< smaller ones
  };
  /// Regions of the whole map that have a surface: of what was taken away, voxels may keep labels.
  [[nodiscard]] RegionCount regionCount();

  /// Bricks whose labels the last frame may have changed.
  [[nodiscard]] std::span<const Eigen::Vector3i> touchedBricks() const { return touched_; }
  /// Labelled voxels near the surface in some bricks, wherever they are. Error: the device failed.
  [[nodiscard]] Result<LabelCloud::Extract> extractCloud(std::span<const Eigen::Vector3i> bricks);
  /// Of the whole map, those of one page together.
  [[nodiscard]] std::vector<Eigen::Vector3i> allBricks() const;
  /// The same of the whole map, point by point, in an order that only depends on where they are.
  [[nodiscard]] Result<void> forEachCloudPoint(const std::function<void(const LabelPoint&)>& visit);
  /// The surface of the whole map; see core/meshing/mesh_extractor.h. Nothing: `may_continue` said false.
  /// Error: the device failed, or memory ran out.
  [[nodiscard]] Result<std::optional<SurfaceMesh>> extractMesh(const MeshProgress& may_continue = {});

 private:
  ScanPipeline(ComputeContext& compute, const Setup& setup)
      : compute_(compute), params_(setup.params), frame_count_(setup.frame_count) {}

  [[nodiscard]] FrameResult runStages(const RgbdFrame& frame, const NextFrame& next);
  /// The depth of `frame`, and its pose.
  std::pair<const DepthPyramid&, PoseEstimate> findPose(const RgbdFrame& frame);
  /// Begins findPose() of the next frame.
  void beginNext(const NextFrame& next);
  [[nodiscard]] Intrinsics closeCamera(const cv::Size& depth) const;
  /// What the map shows there by now; `surface` takes it on the device.
  [[nodiscard]] RenderedView render(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
                                    SurfaceMaps& surface);
  /// `view`: what the map shows where the frame was taken.
  [[nodiscard]] FrameObservation observationOf(const RgbdFrame& frame, const RenderedView& view,
                                               SurfaceInColor in_color) const;
  void findCandidates(CandidateSource& finder, const RegionTable& table,
                      std::span<const std::uint8_t> appeared, FrameResult& result) const;
  /// Discovery learns what became of regions.
  void follow(const RegionEvents& events);
  [[nodiscard]] Result<RegionEditor::Outcome> finishEdit(Result<RegionEditor::Outcome> outcome);
  /// Colours of the surface in CIE L*a*b* by pixel of `K`, a little blurred.
  [[nodiscard]] std::vector<Eigen::Vector3f> labColors(const RgbdFrame& frame, const Intrinsics& K,
                                                       const SurfaceInColor& in_color) const;
  /// Earlier frames whose poses were uncertain, and are certain now, go into the map.
  [[nodiscard]] std::vector<LateFrame> integrateLate();
  /// MergeInput::came of the frame that went through the motion filter last; valid until the next one.
  [[nodiscard]] std::span<const std::uint8_t> appearedRegions();
  /// The voxels along `surface` take the fragments that it was merged with; the bricks that this touched.
  std::span<const Eigen::Vector3i> label(const SurfaceMaps& surface, const RegionMerger::Outcome& merged);
  /// Fragments that no voxel holds any more go; their numbers are used again.
  void forgetFragments();
  [[nodiscard]] Error outOfMemory(int frame_index) const;

  /// Times `work` as a stage. What it leaves running on the device is paid for by the stage that waits for
  /// it.
  template <class Work>
  decltype(auto) stage(std::string_view name, Work&& work);

  ComputeContext& compute_;
  ScanParams params_;
  std::optional<int> frame_count_;
  Intrinsics working_K_;
  StageTimer timer_;

  std::unique_ptr<DepthPreprocessor> preprocessor_;
  std::unique_ptr<PoseTracker> tracker_;  // null: poses are given
  std::unique_ptr<MotionFilter> motion_;
  std::unique_ptr<DenseMap> map_;
  std::optional<ColorIntegrator> color_integrator_;
  std::unique_ptr<GraphSegmenter> segmenter_;
  std::unique_ptr<LabelCloud> cloud_;
  RegionTable table_;
  std::unique_ptr<RegionMerger> merger_;
  ObservationRecorder observations_;
  std::optional<EditableCloud> editable_;
  std::optional<RegionEditor> editor_;
  std::unique_ptr<CandidateFinder> finder_;
  SurfaceMaps observed_;  // what observe() saw last

  SurfaceMaps surface_;    // V_t, N_t of the last usable frame
  KnownSurface known_;     // V_t, on the host
  bool has_pose_ = false;  // the last frame: surface_ is of it
  SurfaceMaps followed_;   // what of it the camera is followed by
  std::span<const Eigen::Vector3i> touched_;
  cv::Mat appeared_;
  int frames_ = 0;  // given to processFrame

  std::future<PoseTracker::TrackingAttempt> next_attempt_;  // uses what is above: goes first
};

}  // namespace scantrove
