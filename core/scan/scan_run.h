#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/latest_value.h"
#include "core/base/result.h"
#include "core/pipeline/object_mask.h"
#include "core/scan/camera_watch.h"
#include "core/scan/scan_advisor.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_parts.h"
#include "core/scan/scan_refinement.h"
#include "core/scan/scan_tally.h"
#include "core/scan/snapshot_builder.h"

namespace scantrove {

/// One scan from its first to its last frame: frames through the pipeline, objects into the catalogue,
/// snapshots and events out, results at the end. One thread, the worker's.
class ScanRun {
 public:
  /// Opens everything that `request` names (ScanOpener). `on_events`: applyCatalogueChanges() has events to
  /// report; called on another thread.
  [[nodiscard]] static Result<std::unique_ptr<ScanRun>> open(const ScanRequest& request,
                                                             ScanListener listener,
                                                             LatestValue<ScanSnapshot>& mailbox,
                                                             std::function<void()> on_events);

  enum class Step { frame, nothing_yet, end };
  /// Reads and processes the next frame. Error: the scan cannot continue.
  [[nodiscard]] Result<Step> step();

  [[nodiscard]] bool hasFrames() const { return tally_->frames().read > 0; }

  /// Posts a snapshot for the window when due. Error: the device failed.
  [[nodiscard]] Result<void> showWhenDue(ScanState state);
  /// Posts a complete snapshot at once. Error: the device failed.
  [[nodiscard]] Result<void> showNow(ScanState state);

  /// Reads and reports changes of the catalogue; frames include this. False: nothing new yet; `on_events`
  /// of open() reports when there is.
  bool applyCatalogueChanges();
  void setParams(const ScanParams& params);
  /// Segments the last frame again with the current parameters for the next snapshot; the map stays
  /// unchanged. Error: the device failed.
  [[nodiscard]] Result<void> segmentAgain();

  /// Applies a user's edit of regions, stores it in the session, and reports the outcome.
  void edit(const ScanEdit& edit);

  /// Wall time to exclude because the user paused.
  void startClock() { tally_->startClock(); }
  void stopClock() { tally_->stopClock(); }

  struct Ending {
    std::function<bool()> refines;         ///< asked before each frame of the refinement
    std::function<void(ScanState)> enter;  ///< called with `refining`, then `finishing`
  };
  /// Refines the objects, writes the results, stores the remaining changes in the catalogue and closes its
  /// session; for every end of a scan, regular or not. A failure does not prevent other outputs. Error: the
  /// first failure (the others are in the log).
  [[nodiscard]] Result<ScanReport> finish(const Ending& ending);

 private:
  ScanRun(ScanListener listener, LatestValue<ScanSnapshot>& mailbox)
      : listener_(std::move(listener)), snapshots_(mailbox) {}

  [[nodiscard]] Result<void> process(RgbdFrame frame);
  [[nodiscard]] Result<void> skip(const FrameRead& read);
  void announce(const FrameObjects& objects);
  void announceMapFailure();
  /// Applies an edit as edit() does.
  void perform(const ScanEdit& edit, bool is_automatic);
  [[nodiscard]] Result<RegionEditor::Outcome> doEdit(const ScanEdit& edit);
  [[nodiscard]] ScanProgress progress(ScanState state) const;
  /// Stores in the session.
  void keepFrame(const RgbdFrame& frame, const FrameResult& result);
  /// Passes the effect of joins on objects to the session (ScanJoins). Requires a recorder.
  void keepJoins();
  void advise(const Error& advice);
  /// Advises on a depth scale that seems wrong.
  void adviseOnDepthScale();
  /// Replaces a young map that misled tracking by a new one, if it has no objects and no edits.
  [[nodiscard]] Result<void> restartIfMisled(int frame_index);
  /// Marks new supports that continue background (ContinuedBackground), so that a person marks a table or
  /// floor once for all scans of a session. Error: the device failed.
  [[nodiscard]] Result<void> carryBackground();
  void refine(const Ending& ending);
  void fillReport(ScanReport& report);
  /// The objects with the objectness of their most likely regions.
  [[nodiscard]] std::vector<CollectedObject> ratedObjects() const;
  /// Error: no frame was integrated into the map.
  [[nodiscard]] Result<void> checkResult(const ScanReport& report) const;

  ScanListener listener_;
  SnapshotBuilder snapshots_;
  ScanParts parts_;
  std::optional<ObjectMask> object_;              // the only one that is scanned
  std::optional<FrameRead> next_read_;            // read from the source ahead of time
  bool is_recording_noted_ = false;               // in the session
  std::optional<Eigen::Vector3d> stored_origin_;  // there: ScanParts::origin_world
  RegionId last_earlier_region_;                  // of earlier scans of the session
  std::optional<ScanTally> tally_;
  std::optional<ScanAdvisor> advisor_;
  std::vector<std::string> advice_;
  ScanRefinement refinement_;
  CameraWatch camera_watch_;
};

}  // namespace scantrove
