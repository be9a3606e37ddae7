#pragma once
#include <memory>
#include <stop_token>
#include <string>

#include "core/base/latest_value.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_request.h"
#include "core/scan/snapshot_builder.h"
#include "core/session/open_session.h"
#include "core/session/session_scan.h"

namespace scantrove {

/// A session under review without new frames: the scan has ended, or was opened again later. Sends the same
/// events as a scan. One thread, the worker's.
class ScanReview {
 public:
  /// Key frames are segmented with `params`. Error: as for OpenSession::open.
  [[nodiscard]] static Result<std::unique_ptr<ScanReview>> open(const ScanRequest& request,
                                                                const ScanParams& params,
                                                                ScanListener listener,
                                                                LatestValue<ScanSnapshot>& mailbox);

  /// Whether refinement was skipped, or the scan was interrupted before it.
  [[nodiscard]] bool canBeRefined() const { return session_->canBeRefined(); }

  /// Posts a complete snapshot. Error: the device failed.
  [[nodiscard]] Result<void> showAll();
  /// Shows a key frame by its index in ScanSnapshot::key_frames, as rendered from the current map. Error:
  /// its images cannot be read; the device failed.
  [[nodiscard]] Result<void> showKeyFrame(int place);

  /// Shows the key frame segmented with these parameters, without other effects. Error: the device failed.
  [[nodiscard]] Result<void> setParams(const ScanParams& params);

  /// Applies a user's edit, stores it in the session, and reports the outcome. Error: the device failed.
  [[nodiscard]] Result<void> edit(const ScanEdit& edit);

  void execute(LabelKeyFrame command);
  void execute(const PreviewExport& command);
  void execute(const SampleExport& command);
  void execute(const ExportDataset& command, const std::stop_token& cancel);
  void execute(const ExportProject& command, const std::stop_token& cancel);
  void execute(const RenderPicture& command, const std::stop_token& cancel);

 private:
  ScanReview(std::unique_ptr<OpenSession> session, ScanListener listener, LatestValue<ScanSnapshot>& mailbox);
  [[nodiscard]] Result<void> post();
  /// The current key frame with its current labels.
  [[nodiscard]] Result<void> showCurrent();
  /// The session's data about the regions of a key frame.
  [[nodiscard]] std::vector<SeenObject> objectsIn(const FrameResult& result, const RgbdFrame& frame) const;
  /// S_t of the current key frame, from the rendered view of the map.
  [[nodiscard]] Result<void> segment();
  /// An event with the value, or ExportFailed.
  template <class Event, class Value>
  void report(const Result<Value>& outcome);

  std::unique_ptr<OpenSession> session_;
  std::string device_;  // as for OpenSession::open
  ScanListener listener_;
  SnapshotBuilder snapshots_;
  std::vector<const SavedKeyFrame*> key_frames_;  // with a pose
  int shown_ = -1;                                // index in key_frames_
  SegmentationParams segmentation_;
  SegmentMap segments_;  // of the key frame segmented_, by segmentation_
  int segmented_ = -1;
};

}  // namespace scantrove
