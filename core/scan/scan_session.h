#pragma once
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/latest_value.h"
#include "core/base/result.h"
#include "core/base/thread_priority.h"
#include "core/capture/frame_source.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/export_sample.h"
#include "core/editing/operation.h"
#include "core/scan/scan_params.h"
#include "core/scan/scan_report.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// What a scan is to do.
struct ScanRequest {
  enum class Poses { tracked, given };
  /// As openSource takes it. Empty: nothing is scanned, the session in `output_folder` is looked at.
  std::string source;
  SourceOptions source_options;
  Poses poses = Poses::tracked;
  ScanParams params;
  std::string device;    ///< as chooseDevice takes it
  std::string database;  ///< catalogue to search and add to; empty, with `resume`: that of the session
  std::optional<std::filesystem::path>
      output_folder;    ///< where results go; none: nothing but the catalogue is written
  bool session = true;  ///< keep the scan there, so that it can be opened again
  bool results = true;  ///< write trajectory, cloud and report there, not the session only
  bool label_maps = false;
  bool record_all = false;  ///< keep the images of every frame in the session, not of key frames only
  /// Go on in the session that is in `output_folder`; else a new one begins there.
  bool resume = false;
  /// Begin in a folder with files that no scan wrote (see checkHoldsOnlyOurs()).
  bool overwrite = false;
  /// When the scan has ended, its session stays open until the next one starts: it can be edited, its key
  /// frames looked at, and data sets made of it.
  bool review = false;
  bool skip_refinement = false;  ///< leave the pass after the last frame for later
  /// Scan nothing; do the refinement that the session in `output_folder` has not had, with its own source,
  /// camera and parameters.
  bool refine_session = false;
  bool start_paused = false;
  bool pictures = true;          ///< snapshots hold what is looked at; else numbers alone
  bool profile_kernels = false;  ///< measures every kernel by itself, which takes time
  /// How long the end of the scan waits for a catalogue in which nothing can be stored.
  std::chrono::milliseconds catalogue_patience{20000};
};

/// Things that must not be lost, in order.
struct StateChanged {
  ScanState state;
};
/// The scan refines its objects with its key frames; `steps` is the same from beginning to end.
struct RefinementStepped {
  int done = 0, steps = 1;
  int key_frames = 0;
  /// 1 ... key_frames. Each is used several times; the steps tell how much of all work is done.
  [[nodiscard]] int keyFrame() const { return std::min(key_frames, 1 + done * key_frames / steps); }
};
struct PreparingDevice {};  ///< kernels are compiled, which takes long and happens once on a device
struct ObjectAdded {
  ObjectId object;
  std::string name;
};  ///< a new row of the catalogue; it is committed
struct ObjectRecognized {
  ObjectId object;
  std::string name;
};  ///< first time in this scan
struct ViewAdded {
  ObjectId object;
};  ///< another view of an object was kept
struct ObjectsMerged {
  ObjectId into;
  std::vector<ObjectId> from;
};  ///< the regions of these objects turned out to be one
struct ObjectLeft {
  ObjectId object;
};  ///< it was removed: in the end its regions are not what its views show
struct ObjectNamed {
  ObjectId object;
  std::string name;
};  ///< a person named a region: this object is called so now, and confirmed; it is committed
struct CatalogueFailed {
  Error error;
};  ///< the catalogue cannot be read or written for now; the scan goes on, what is found waits
struct MapFailed {
  Error error;
};  ///< a part of the map cannot be written to disk for now, or not be read back; the scan goes on
struct MapDrifted {
  Error error;
};  ///< the camera is back at a place that the map has beside where it was: what is seen there is in it twice
struct ScanAdvice {
  Error error;
};  ///< something about the scan as a whole that a person can mend; the scan goes on
/// Takes the newest operation back, or does it again.
struct UndoEdit {};
struct RedoEdit {};
using ScanEdit = std::variant<Operation, UndoEdit, RedoEdit>;

struct Edited {
  ScanEdit edit;
  std::vector<RegionId> regions;  ///< what it was about is now
};                                ///< a person's operation holds, and is on disk where the scan has a session
struct EditFailed {
  ScanEdit edit;
  Error error;
};  ///< a person's operation changed nothing, or is not on disk
/// The session of the scan that has ended, or that was opened, can be worked with.
struct ReviewOpened {
  bool can_refine = false;  ///< its refinement was skipped, or it never came to that
};
struct ExportPreviewed {
  ExportPreview preview;
};
struct ExportSampled {
  ExportSample sample;
};
struct ExportStepped {
  ExportProgress progress;
};
struct ExportFinished {
  ExportSummary summary;
};
struct ExportFailed {
  Error error;
};
struct FrameSkipped {
  int frame_index;
  Error error;
};
struct ScanFailed {
  Error error;
};
struct ScanFinished {
  ScanReport report;
};
using ScanEvent =
    std::variant<StateChanged, RefinementStepped, PreparingDevice, ObjectAdded, ObjectRecognized, ViewAdded,
                 ObjectsMerged, ObjectLeft, ObjectNamed, CatalogueFailed, MapFailed, MapDrifted, ScanAdvice,
                 Edited, EditFailed, ReviewOpened, ExportPreviewed, ExportSampled, ExportStepped,
                 ExportFinished, ExportFailed, FrameSkipped, ScanFailed, ScanFinished>;

/// Runs one scan after the other on a worker thread that owns device and pipeline.
/// All public functions are for one thread (the window's or the command line's); none waits for a frame.
class ScanSession {
 public:
  using Listener = std::function<void(const ScanEvent&)>;

  /// `listener` is called on the worker thread, in order; it must return quickly (a window queues the event).
  /// `niceness`: of the worker, and of the device's threads where they are the processor's.
  explicit ScanSession(Listener listener, Niceness niceness = Niceness::none);
  ~ScanSession();  ///< stops and waits
  ScanSession(const ScanSession&) = delete;
  ScanSession& operator=(const ScanSession&) = delete;

  /// Stops what runs, then starts `request` on the worker. Failures arrive as ScanFailed.
  void start(ScanRequest request);
  void pause();
  void resume();
  void step();   ///< one frame while paused
  void stop();   ///< ends the scan cleanly: results are written, ScanFinished follows
  void close();  ///< the same, and the session is open no longer
  /// The scan that runs is not refined, or no further; it can be done later.
  void skipRefinement();
  void wait();  ///< until the scan that runs has ended

  /// A person does something to the regions: between two frames, or to a session that is open. In order;
  /// Edited or EditFailed follows.
  void edit(ScanEdit edit);

  /// Of a session that is open: shows a key frame, by its place in ScanSnapshot::key_frames; of several that
  /// were asked for meanwhile the last.
  void showKeyFrame(int place);
  /// What a data set would hold, one of its images (of several that were asked for meanwhile the last), and
  /// makes one. ExportPreviewed; ExportSampled; ExportStepped, ExportFinished, ExportFailed follow. While no
  /// session is open: ExportFailed.
  void previewExport(ExportOptions options);
  void sampleExport(ExportOptions options, std::optional<int> place);
  void exportDataset(ExportOptions options);
  void cancelExport();

  /// The catalogue was edited. Frames see that by themselves; this is for a scan that is paused.
  void catalogueChanged();

  /// Replaces the parameters before the next frame (those of fusion need a new scan). The frame that a paused
  /// scan, or an open session, shows is segmented by them at once: of ScanSnapshot only `segments` changes.
  void setParams(const ScanParams& params);

  [[nodiscard]] ScanState state() const;  ///< any thread
  [[nodiscard]] LatestValue<ScanSnapshot>& snapshots();

 private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

}  // namespace scantrove
