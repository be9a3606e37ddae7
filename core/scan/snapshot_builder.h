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

/// The progress of a scan.
struct ScanProgress {
  ScanState state = ScanState::idle;
  FrameCounts frames;
  int frames_total = 0;  ///< 0 = unknown (live)
};

/// Builds the snapshots of one scan. Works only when the window has taken the last one and enough time has
/// passed. Each snapshot has a bounded number of label-cloud bricks, in the order of WaitingBricks. One
/// thread, the worker's.
class SnapshotBuilder {
 public:
  /// Maximum in one snapshot during a scan, and per read-out at its end: bounds time per frame, and memory.
  static constexpr std::size_t kMaxBricks = 1500;

  /// `first_version`: above that of all bricks that the window has.
  explicit SnapshotBuilder(LatestValue<ScanSnapshot>& mailbox, std::uint64_t first_version = 0)
      : mailbox_(mailbox), version_(first_version) {}

  /// Call for every frame: stores it, its objects, its position on the trail and the bricks it changed.
  void addFrame(const MappingPipeline& pipeline, RgbdFrame frame, FrameResult result,
                std::vector<SeenObject> objects = {});

  /// Bricks that changed for other reasons than a frame.
  void addBricks(std::span<const Eigen::Vector3i> bricks);

  /// Another map replaces this one: its bricks are shown instead.
  void restart(MappingPipeline& given_up);

  /// From now on snapshots contain only numbers: no images, regions or bricks.
  void omitPictures() { has_pictures_ = false; }
  /// Encloses a user's edit of regions: its changes are sent first, and marked.
  void beginEdit(MappingPipeline& pipeline) { keepRegionChanges(pipeline, false); }
  void endEdit(MappingPipeline& pipeline);

  /// For review: see ScanSnapshot; `numbers`: SavedFrame::number of each. Of earlier frames only the camera
  /// trail.
  void setKeyFrames(std::vector<int> key_frames, std::vector<int> numbers,
                    std::vector<Eigen::Vector3f> trail);
  void setShownKeyFrame(int place) { shown_key_frame_ = place; }
  /// An earlier frame, rendered from the current map.
  void showFrame(RgbdFrame frame, FrameResult result, std::vector<SeenObject> objects) {
    frame_ = std::move(frame);
    result_ = std::move(result);
    objects_ = std::move(objects);
  }
  /// The same frame, segmented again.
  void showSegments(SegmentMap segments) { result_.segments = std::move(segments); }
  /// Sources of region labels, and of an object's data while that may change.
  struct Labels {
    std::function<std::map<RegionId, RegionLabel>()> of_regions;
    std::function<void(SeenObject&)> describe = {};
  };
  void setLabels(Labels labels) { labels_ = std::move(labels); }

  /// Posts a snapshot if the last one was taken and is old enough. Error: the device failed.
  [[nodiscard]] Result<void> postWhenDue(MappingPipeline& pipeline, const ScanProgress& progress);

  /// Posts a snapshot at once, with all waiting bricks: at a pause, a step, the end. Error: the device
  /// failed.
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
  void addReviews(const MappingPipeline& pipeline, ScanSnapshot& snapshot) const;
  void measureRate();

  LatestValue<ScanSnapshot>& mailbox_;
  bool has_pictures_ = true;
  RgbdFrame frame_;
  FrameResult result_;
  std::vector<SeenObject> objects_;  // in frame_
  cv::Mat last_seen_;                // colour image of the last frame with a pose
  cv::Mat last_color_;               // of the last frame with colour
  std::vector<Eigen::Vector3f> trail_;
  WaitingBricks waiting_;
  std::vector<RegionChange> region_changes_;                       // waiting
  std::uint64_t version_;                                          // of the sent bricks
  std::deque<std::chrono::steady_clock::time_point> frame_times_;  // of the last second
  std::chrono::steady_clock::time_point last_post_;
  double fps_ = 0;
  std::shared_ptr<const std::vector<int>> key_frames_;
  std::vector<int> key_frame_numbers_;  // SavedFrame::number of each
  int shown_key_frame_ = -1;
  Labels labels_;
};

}  // namespace scantrove
