#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/base/latest_value.h"
#include "core/base/result.h"
#include "core/capture/continued_source.h"
#include "core/capture/frame_source.h"
#include "core/capture/local_poses.h"
#include "core/compute/compute_context.h"
#include "core/scan/first_error.h"
#include "core/scan/refinement_memory.h"
#include "core/scan/scan_advisor.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_objects.h"
#include "core/scan/scan_output.h"
#include "core/scan/scan_pipeline.h"
#include "core/scan/scan_request.h"
#include "core/scan/session_recorder.h"
#include "core/scan/snapshot_builder.h"

namespace scantrove {

/// One scan from its first to its last frame: source, device, catalogue, pipeline, results. One thread, the
/// worker's.
class ScanRun {
 public:
  /// Opens everything that `request` names. Error: what cannot be opened, or would not fit the device. The
  /// result folder and the catalogue may have been made by then. `on_news`: followCatalogue() has something
  /// to tell; called on another thread.
  [[nodiscard]] static Result<std::unique_ptr<ScanRun>> open(const ScanRequest& request,
                                                             ScanListener listener,
                                                             LatestValue<ScanSnapshot>& mailbox,
                                                             std::function<void()> on_news);
  ~ScanRun();

  enum class Step { frame, nothing_yet, end };
  /// Reads and processes the next frame. Error: the scan cannot go on.
  [[nodiscard]] Result<Step> step();

  [[nodiscard]] bool hasFrames() const { return frames_.read > 0; }

  /// Posts a snapshot for the window if it is time for one. Error: the device failed.
  [[nodiscard]] Result<void> showWhenDue(ScanState state);

  /// Posts a snapshot at once, with all that changed. Error: the device failed.
  [[nodiscard]] Result<void> showNow(ScanState state);

  /// Learns what became of the catalogue meanwhile and tells it; frames do so by themselves. False: nothing
  /// new so far; `on_news` of open() says when there is.
  bool followCatalogue();
  void setParams(const ScanParams& params);
  /// The last frame's segments as the present parameters give them, for the next snapshot; the map stays as
  /// it is. Error: the device failed.
  [[nodiscard]] Result<void> segmentAgain();

  /// Does what a person says to the regions, keeps it in the session, and tells how it went.
  void edit(const ScanEdit& edit);

  /// Wall time that must not count, because a person paused.
  void startClock();
  void stopClock();

  struct Ending {
    std::function<bool()> refines;         ///< asked before each frame of the refinement
    std::function<void(ScanState)> enter;  ///< told `refining`, then `finishing`
  };
  /// Refines the objects, writes the results, stores what waits for the catalogue and closes its session; for
  /// every end of a scan, good or bad. What fails keeps nothing else from being written. Error: the first
  /// failure (the others are in the log).
  [[nodiscard]] Result<ScanReport> finish(const Ending& ending);

 private:
  ScanRun(ScanRequest request, ScanListener listener, LatestValue<ScanSnapshot>& mailbox)
      : request_(std::move(request)),
        listener_(std::move(listener)),
        snapshots_(mailbox),
        advisor_(request_.params.fusion.max_depth_m) {}

  [[nodiscard]] Result<void> process(RgbdFrame frame);
  [[nodiscard]] Result<void> skip(const FrameRead& read);
  void count(const FrameResult& result, int frame_index);
  /// How far the map has drifted, where the frame tells it.
  void measureDrift(const FrameResult& result, int frame_index);
  void announce(const FrameObjects& objects);
  void announceMapFailure();
  /// Error: the folder holds files of others.
  [[nodiscard]] Result<void> checkFolder() const;
  /// Opens what the frames come from; of a session that is only refined, the session.
  [[nodiscard]] Result<void> openFrames();
  [[nodiscard]] Result<void> openSessionToRefine();
  [[nodiscard]] Result<void> makePipeline();
  /// The earlier scan knows its objects by another catalogue's numbers.
  [[nodiscard]] bool isOfAnotherCatalogue() const;
  /// Begins the session, or goes on in it. An earlier one gives way to the first usable frame.
  [[nodiscard]] Result<void> openSession(const SourceInfo& info);
  [[nodiscard]] Result<void> beginSession(const SourceInfo& info);
  /// The camera of the earlier scan must be this one; its map's parameters are taken over.
  [[nodiscard]] Result<void> readSession(const SourceInfo& info);
  /// Reads the session. Where it was interrupted while it told its catalogue something, that comes first.
  [[nodiscard]] Result<void> loadEarlier(std::vector<std::string>& damages);
  [[nodiscard]] Result<void> resumeSession(ObjectDatabase& database);
  /// The session keeps what a refinement that is not done goes on with.
  void keepRefinement();
  [[nodiscard]] Result<RegionEditor::Outcome> doEdit(const ScanEdit& edit);
  [[nodiscard]] ScanProgress progress(ScanState state) const;
  void fillReport(ScanReport& report);
  /// The objects, with the key frames that the session has.
  void refine(const Ending& ending);
  [[nodiscard]] Result<void> runRefinement(const Ending& ending);
  /// The recording's poses are taken: relative to where the scan begins, or began.
  void takePoses();
  void setOrigin(const Eigen::Vector3d& origin_world);
  /// Frame numbers and times go on after those of the earlier frames.
  void continueNumbers(const std::vector<SavedFrame>& earlier);
  void keepFrame(const RgbdFrame& frame, const FrameResult& result);
  /// The session has all that is known. There is a recorder.
  [[nodiscard]] Result<void> save();
  /// A new map takes the place of the one that there is, if any, and a new collector.
  [[nodiscard]] Result<void> createPipeline(ObjectDatabase& database);
  void advise(const Error& advice);
  /// After each frame.
  [[nodiscard]] Result<void> followAdvisor(const RgbdFrame& frame, bool is_usable);
  /// The map can be given up: nothing was found in it, and nobody did anything to it.
  [[nodiscard]] bool isUntouched() const;
  /// Gives the map up for a new one.
  [[nodiscard]] Result<void> beginAnew(int frame_index);
  /// Error: nothing of what the frames show came into the map.
  [[nodiscard]] Result<void> checkResult(const ScanReport& report) const;

  ScanRequest request_;
  ScanListener listener_;
  std::function<void()> on_news_;
  SnapshotBuilder snapshots_;
  std::unique_ptr<FrameSource> source_;
  std::unique_ptr<ScanOutput> output_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<ScanPipeline> pipeline_;
  std::unique_ptr<ScanObjects> objects_;                    // of pipeline_
  std::unique_ptr<SessionWriter> session_;                  // until the recorder has it
  std::optional<SavedScan> earlier_;                        // what the session had
  ContinuedSource* continued_ = nullptr;                    // source_, if the scan goes on with it
  LocalPoses* local_poses_ = nullptr;                       // source_ or in it, where its poses are taken
  Eigen::Vector3d origin_world_ = Eigen::Vector3d::Zero();  // of the map, in the recording's world
  bool is_recording_noted_ = false;                         // in the session
  std::unique_ptr<SessionRecorder> recorder_;               // null: nothing is kept, or nothing yet
  bool keeps_earlier_scan_ = false;                         // the folder's, until this one has a usable frame
  std::string catalogue_;                                   // identity

  std::optional<FrameRead> next_read_;  // taken from the source before its turn
  FrameCounts frames_;
  std::vector<int> lost_frames_;
  std::vector<int> first_usable_;  // indices of the map's first frames
  ScanAdvisor advisor_;
  std::vector<std::string> advice_;
  MapDrift drift_;
  std::vector<double> frame_ms_;
  double elapsed_s_ = 0;
  ScanReport::Refinement refinement_;
  RefinementMemory refinement_memory_;  // where it stops, or has stopped
  std::optional<std::chrono::steady_clock::time_point> clock_start_;
};

}  // namespace scantrove
