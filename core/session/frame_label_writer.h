#pragma once
#include <Eigen/Geometry>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/fusion/rendered_view.h"
#include "core/segmentation/segment_map.h"
#include "core/session/final_label_record.h"
#include "core/session/region_numbers.h"

namespace scantrove {

/// Writes the label images of a scan (segments/, labels/, labels-final/) on its own thread: scales each
/// frame's labels to the input's resolution, numbers the regions in frame order, encodes and writes. At
/// most kMaxWaiting frames wait (about 1.5 MB each); with more, add() waits. Every added frame is written,
/// or finish() reports why not. All functions for one thread.
class FrameLabelWriter {
 public:
  static constexpr std::size_t kMaxWaiting = 8;

  struct Frame {
    int index = 0;
    cv::Mat depth;  ///< of the input; sets the images' resolution
    float meters_per_unit = 0.001F;
    SegmentMap segments;
    std::vector<RegionId> regions;  ///< as RenderedView::regions, at the segments' size
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    std::optional<Intrinsics> intrinsics = {};  ///< RgbdFrame::intrinsics
  };

  /// The finished map rendered from one pose, for a frame with this RgbdFrame::intrinsics.
  using RenderView = std::function<Result<RenderedView>(const Eigen::Isometry3d& T_world_camera,
                                                        const std::optional<Intrinsics>& intrinsics)>;

  /// The three folders exist in `folder`; only this writer uses `numbers` until finish() has returned.
  FrameLabelWriter(std::filesystem::path folder, RegionNumbers& numbers);
  ~FrameLabelWriter();  ///< waits for the added frames
  FrameLabelWriter(const FrameLabelWriter&) = delete;
  FrameLabelWriter& operator=(const FrameLabelWriter&) = delete;

  /// Error: an earlier frame could not be written; no more are accepted.
  [[nodiscard]] Result<void> add(Frame frame);

  /// Waits for all frames, then writes each frame's labels from the finished map, whose regions and voxels
  /// have changed since. `render` is called on this thread. No add() afterwards. Error: the first file that
  /// could not be written.
  [[nodiscard]] Result<void> finish(const RenderView& render);

  /// Waits for all frames, then removes the written images. No add() afterwards.
  void discard();

  /// After finish(): the images that it wrote in labels-final/.
  [[nodiscard]] FinalLabelRecord written() const;

  /// Encodes an image in labels-final/ for a frame with this depth. Error: names `file`.
  [[nodiscard]] static Result<std::string> drawFinal(const std::filesystem::path& file,
                                                     const RenderedView& view, const cv::Mat& depth,
                                                     float meters_per_unit, RegionNumbers& numbers);

 private:
  void run();
  [[nodiscard]] Result<void> write(const Frame& frame);
  struct Written {
    FinalLabelImage image;
    std::filesystem::path depth_file;  ///< temporary copy of the frame's depth
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    std::optional<Intrinsics> intrinsics;
    bool has_final = false;  ///< its image in labels-final/ exists
  };
  [[nodiscard]] Result<void> writeFinal(Written& frame, const RenderedView& view);
  void close();

  std::filesystem::path folder_;
  RegionNumbers& numbers_;        // only for the thread until it ends, like written_
  std::vector<Written> written_;  // in order

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> waiting_;  // guarded by mutex_, like the two below
  bool is_closed_ = false;
  Result<void> outcome_;
  std::thread thread_;  // last: uses all members above
};

}  // namespace scantrove
