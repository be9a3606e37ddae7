#pragma once
#include <Eigen/Geometry>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/fusion/rendered_view.h"
#include "core/scan/region_numbers.h"
#include "core/segmentation/segment_map.h"
#include "core/session/final_label_record.h"

namespace scantrove {

/// Writes the label images of a scan (segments/, labels/, labels-final/) beside it, on a thread of its own:
/// brings each frame's labels to the input's resolution, gives the regions their numbers in the order of the
/// frames, encodes and writes. At most kMaxWaiting frames wait (about 1.5 MB each); with more, add() waits.
/// Every frame that add() took is written, or finish() says why not. All functions for one thread.
class FrameLabelWriter {
 public:
  static constexpr std::size_t kMaxWaiting = 8;

  struct Frame {
    int index = 0;
    cv::Mat depth;  ///< of the input: its resolution is the images'
    float meters_per_unit = 0.001F;
    SegmentMap segments;
    std::vector<RegionId> regions;  ///< as RenderedView::regions, of the segments' size
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  };

  /// The finished map as seen from one place.
  using RenderView = std::function<Result<RenderedView>(const Eigen::Isometry3d& T_world_camera)>;

  /// The three folders exist in `folder`; `numbers` are this writer's alone until finish() has returned.
  FrameLabelWriter(std::filesystem::path folder, RegionNumbers& numbers);
  ~FrameLabelWriter();  ///< waits for the frames that were taken
  FrameLabelWriter(const FrameLabelWriter&) = delete;
  FrameLabelWriter& operator=(const FrameLabelWriter&) = delete;

  /// Error: an earlier frame could not be written; no more are.
  [[nodiscard]] Result<void> add(Frame frame);

  /// Waits for all frames, then writes what the map shows of each by now: regions have joined and parted, and
  /// voxels changed, since it came. `look` is called from this thread. No add() afterwards. Error: the first
  /// file that could not be written.
  [[nodiscard]] Result<void> finish(const RenderView& look);

  /// Waits for all frames, then removes the images that were written. No add() afterwards.
  void discard();

  /// After finish(): the images in labels-final/ that it wrote.
  [[nodiscard]] FinalLabelRecord written() const;

  /// The bytes of an image in labels-final/ of a frame with this depth. Error: names `file`.
  [[nodiscard]] static Result<std::string> drawFinal(const std::filesystem::path& file,
                                                     const RenderedView& view, const cv::Mat& depth,
                                                     float meters_per_unit, RegionNumbers& numbers);

 private:
  void run();
  [[nodiscard]] Result<void> write(const Frame& frame);
  struct Written {
    FinalLabelImage image;
    std::filesystem::path depth_file;  ///< where the frame's depth waits for the end
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    bool has_final = false;  ///< its image in labels-final/ is there
  };
  [[nodiscard]] Result<void> writeFinal(Written& frame, const RenderedView& view);
  void close();

  std::filesystem::path folder_;
  RegionNumbers& numbers_;        // the thread's until it has ended, like written_
  std::vector<Written> written_;  // in order

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> waiting_;  // guarded by mutex_, like the two below
  bool is_closed_ = false;
  Result<void> outcome_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace scantrove
