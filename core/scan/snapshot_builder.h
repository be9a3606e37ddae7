#pragma once
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/base/latest_value.h"
#include "core/capture/rgbd_frame.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/scan/scan_snapshot.h"
#include "core/scan/waiting_bricks.h"
#include "core/session/region_label.h"

namespace scantrove {

/// How far a scan has come.
struct ScanProgress {
  ScanState state = ScanState::idle;
  FrameCounts frames;
  int frames_total = 0;  ///< 0 = unknown (live)
};

/// Makes the snapshots of one scan. Works only when the window has collected the last one and enough time has
/// passed, and sends a bounded number of label-cloud bricks each time, in the order of WaitingBricks. One
/// thread, the worker's.
class SnapshotBuilder {
 public:
  /// In one snapshot while scanning, and read out at a time at its end: bounds what it takes from a frame,
  /// and of memory.
  static constexpr std::size_t kMaxBricks = 1500;

  /// `first_version`: above that of all bricks that the window has already.
  explicit SnapshotBuilder(LatestValue<ScanSnapshot>& mailbox, std::uint64_t first_version = 0)
      : mailbox_(mailbox), version_(first_version) {}

  /// Call for every frame: remembers it, the objects in it, its place on the trail and the bricks it changed.
  void addFrame(const MappingPipeline& pipeline, RgbdFrame frame, FrameResult result,
                std::vector<SeenObject> objects = {});

  /// Bricks that something else than a frame changed.
  void addBricks(std::span<const Eigen::Vector3i> bricks);

  /// Another map takes the place of this one: its bricks are shown as they are there.
  void beginAnew(MappingPipeline& given_up);

  /// Snapshots hold numbers alone from now on: no images, no regions, no bricks.
  void omitPictures() { has_pictures_ = false; }
  /// Around something that a person does to the regions: what that changes is sent before all else, and
  /// marked.
  void beginEdit(MappingPipeline& pipeline) { keepRegionChanges(pipeline, false); }
  void endEdit(MappingPipeline& pipeline);

  /// What is looked at when no frames come: see ScanSnapshot. Of earlier frames the way of the camera.
  void setKeyFrames(std::vector<int> key_frames, std::vector<Eigen::Vector3f> trail);
  void setShownKeyFrame(int place) { shown_key_frame_ = place; }
  /// A frame of before, as the map shows it now.
  void showFrame(RgbdFrame frame, FrameResult result, std::vector<SeenObject> objects) {
    frame_ = std::move(frame);
    result_ = std::move(result);
    objects_ = std::move(objects);
  }
  /// The same frame, segmented anew.
  void showSegments(SegmentMap segments) { result_.segments = std::move(segments); }
  /// Who says what there is to say of the regions, and, while that may change, of an object that was seen.
  struct Labels {
    std::function<std::map<RegionId, RegionLabel>()> of_regions;
    std::function<void(SeenObject&)> describe = {};
  };
  void setLabels(Labels labels) { labels_ = std::move(labels); }

  /// Posts a snapshot if the last one was collected and is old enough. Error: the device failed.
  [[nodiscard]] Result<void> postWhenDue(MappingPipeline& pipeline, const ScanProgress& progress);

  /// Posts what there is at once, with all bricks that still wait: at a pause, a step, the end.
  /// Error: the device failed.
  [[nodiscard]] Result<void> flush(MappingPipeline& pipeline, const ScanProgress& progress);

 private:
  enum class Bricks { due, all };
  [[nodiscard]] Result<void> post(MappingPipeline& pipeline, const ScanProgress& progress, Bricks which);
  [[nodiscard]] Result<void> addChangedBricks(MappingPipeline& pipeline, Bricks which,
                                              ScanSnapshot& snapshot);
  [[nodiscard]] Result<void> readBricks(MappingPipeline& pipeline,
                                        std::span<const WaitingBricks::Brick> bricks,
                                        std::vector<CloudBrick>& to);
  void keepRegionChanges(MappingPipeline& pipeline, bool by_person);
  void addPictures(ScanSnapshot& snapshot) const;
  void addRegions(MappingPipeline& pipeline, ScanSnapshot& snapshot) const;
  void measureRate();

  LatestValue<ScanSnapshot>& mailbox_;
  bool has_pictures_ = true;
  RgbdFrame frame_;
  FrameResult result_;
  std::vector<SeenObject> objects_;  // in frame_
  cv::Mat last_seen_;                // colour image of the last frame with a pose
  std::vector<Eigen::Vector3f> trail_;
  WaitingBricks waiting_;
  std::vector<RegionChange> region_changes_;                       // that wait
  std::uint64_t version_;                                          // of the bricks that are sent
  std::deque<std::chrono::steady_clock::time_point> frame_times_;  // of the last second
  std::chrono::steady_clock::time_point last_post_;
  double fps_ = 0;
  std::shared_ptr<const std::vector<int>> key_frames_;
  int shown_key_frame_ = -1;
  Labels labels_;
};

}  // namespace scantrove
