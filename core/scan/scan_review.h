#pragma once
#include <memory>
#include <stop_token>

#include "core/base/latest_value.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_request.h"
#include "core/scan/snapshot_builder.h"
#include "core/session/open_session.h"
#include "core/session/session_scan.h"

namespace scantrove {

/// A session that a person looks at and corrects when no frames come: the scan has ended, or was opened again
/// later. Tells the same news as a scan. One thread, the worker's.
class ScanReview {
 public:
  /// Key frames are segmented by `params`. Error: as of OpenSession::open.
  [[nodiscard]] static Result<std::unique_ptr<ScanReview>> open(const ScanRequest& request,
                                                                const ScanParams& params,
                                                                ScanListener listener,
                                                                LatestValue<ScanSnapshot>& mailbox);

  /// Its refinement was skipped, or it never came to that.
  [[nodiscard]] bool canBeRefined() const { return session_->canBeRefined(); }

  /// Posts a snapshot of all that is there. Error: the device failed.
  [[nodiscard]] Result<void> showAll();
  /// Shows a key frame, by its place in ScanSnapshot::key_frames, as the map shows it now. Error: its images
  /// cannot be read; the device failed.
  [[nodiscard]] Result<void> showKeyFrame(int place);

  /// Shows the key frame segmented by these; nothing else comes of them. Error: the device failed.
  [[nodiscard]] Result<void> setParams(const ScanParams& params);

  /// Does what a person says, keeps it in the session, and tells how it went. Error: the device failed.
  [[nodiscard]] Result<void> edit(const ScanEdit& edit);

  void execute(const PreviewExport& command);
  void execute(const SampleExport& command);
  void execute(const ExportDataset& command, const std::stop_token& cancel);

 private:
  ScanReview(std::unique_ptr<OpenSession> session, ScanListener listener, LatestValue<ScanSnapshot>& mailbox);
  [[nodiscard]] Result<void> post();
  /// The key frame that is shown, with the labels as they are now.
  [[nodiscard]] Result<void> lookAgain();
  /// What the session knows of the regions of a key frame.
  [[nodiscard]] std::vector<SeenObject> objectsIn(const FrameResult& result, const RgbdFrame& frame) const;
  /// S_t of the key frame that is shown: of what the map shows from there.
  [[nodiscard]] Result<void> segment();
  /// An Event with the value, or ExportFailed.
  template <class Event, class Value>
  void report(const Result<Value>& outcome);

  std::unique_ptr<OpenSession> session_;
  ScanListener listener_;
  SnapshotBuilder snapshots_;
  std::vector<const SavedKeyFrame*> key_frames_;  // with a pose
  int shown_ = -1;                                // of key_frames_
  SegmentationParams segmentation_;
  SegmentMap segments_;  // of the key frame segmented_, by segmentation_
  int segmented_ = -1;
};

}  // namespace scantrove
