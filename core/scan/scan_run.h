#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/latest_value.h"
#include "core/base/result.h"
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
  /// Opens everything that `request` names (ScanOpener). `on_events`: followCatalogue() has something to
  /// tell; called on another thread.
  [[nodiscard]] static Result<std::unique_ptr<ScanRun>> open(const ScanRequest& request,
                                                             ScanListener listener,
                                                             LatestValue<ScanSnapshot>& mailbox,
                                                             std::function<void()> on_events);

  enum class Step { frame, nothing_yet, end };
  /// Reads and processes the next frame. Error: the scan cannot go on.
  [[nodiscard]] Result<Step> step();

  [[nodiscard]] bool hasFrames() const { return tally_->frames().read > 0; }

  /// Posts a snapshot for the window if it is time for one. Error: the device failed.
  [[nodiscard]] Result<void> showWhenDue(ScanState state);
  /// Posts a snapshot at once, with all that changed. Error: the device failed.
  [[nodiscard]] Result<void> showNow(ScanState state);

  /// Learns what became of the catalogue meanwhile and tells it; frames do so by themselves. False: nothing
  /// new so far; `on_events` of open() says when there is.
  bool followCatalogue();
  void setParams(const ScanParams& params);
  /// The last frame's segments as the present parameters give them, for the next snapshot; the map stays as
  /// it is. Error: the device failed.
  [[nodiscard]] Result<void> segmentAgain();

  /// Does what a user says to the regions, keeps it in the session, and tells how it went.
  void edit(const ScanEdit& edit);

  /// Wall time that must not count, because a user paused.
  void startClock() { tally_->startClock(); }
  void stopClock() { tally_->stopClock(); }

  struct Ending {
    std::function<bool()> refines;         ///< asked before each frame of the refinement
    std::function<void(ScanState)> enter;  ///< told `refining`, then `finishing`
  };
  /// Refines the objects, writes the results, stores what waits for the catalogue and closes its session; for
  /// every end of a scan, good or bad. What fails keeps nothing else from being written. Error: the first
  /// failure (the others are in the log).
  [[nodiscard]] Result<ScanReport> finish(const Ending& ending);

 private:
  ScanRun(ScanListener listener, LatestValue<ScanSnapshot>& mailbox)
      : listener_(std::move(listener)), snapshots_(mailbox) {}

  [[nodiscard]] Result<void> process(RgbdFrame frame);
  [[nodiscard]] Result<void> skip(const FrameRead& read);
  void announce(const FrameObjects& objects);
  void announceMapFailure();
  [[nodiscard]] Result<RegionEditor::Outcome> doEdit(const ScanEdit& edit);
  [[nodiscard]] ScanProgress progress(ScanState state) const;
  /// Into the session.
  void keepFrame(const RgbdFrame& frame, const FrameResult& result);
  /// Gives the session what joins did to objects (ScanJoins). There is a recorder.
  void keepJoins();
  void advise(const Error& advice);
  /// A young map that misled the camera is given up for a new one, where nothing was found in it and nobody
  /// did anything to it.
  [[nodiscard]] Result<void> beginAnewIfMisled(int frame_index);
  void refine(const Ending& ending);
  void fillReport(ScanReport& report);
  /// Error: nothing of what the frames show came into the map.
  [[nodiscard]] Result<void> checkResult(const ScanReport& report) const;

  ScanListener listener_;
  SnapshotBuilder snapshots_;
  ScanParts parts_;
  std::optional<FrameRead> next_read_;  // taken from the source before its turn
  bool is_recording_noted_ = false;     // in the session
  std::optional<ScanTally> tally_;
  std::optional<ScanAdvisor> advisor_;
  std::vector<std::string> advice_;
  ScanRefinement refinement_;
};

}  // namespace scantrove
