#pragma once
#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/export_sample.h"
#include "core/scan/key_frame_labels.h"
#include "core/scan/scan_command.h"
#include "core/scan/scan_report.h"
#include "core/scan/scan_state.h"

namespace scantrove {

// Events of a scan, or of the review of its session. None is lost, and they arrive in order.

struct StateChanged {
  ScanState state;
};
/// The scan refines its objects with its key frames; `steps` does not change in between.
struct RefinementStepped {
  int done = 0, steps = 1;
  int key_frames = 0;
  /// 1 ... key_frames. Each is used several times; the steps measure the overall progress.
  [[nodiscard]] int keyFrame() const { return std::min(key_frames, 1 + done * key_frames / steps); }
};
struct PreparingDevice {};  ///< kernels are being compiled, which takes long and happens once per device
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
};  ///< another view of an object was stored
struct ObjectsMerged {
  ObjectId into;
  std::vector<ObjectId> from;
};  ///< the regions of these objects belong to one object
struct ObjectRemoved {
  ObjectId object;
};  ///< it was removed: its views show something else than its regions
struct ObjectNamed {
  ObjectId object;
  std::string name;
};  ///< a user named a region: its object has this name and is confirmed; committed
struct CatalogueFailed {
  Error error;
};  ///< the catalogue cannot be read or written now; the scan goes on, and results wait
struct MapFailed {
  Error error;
};  ///< a part of the map cannot be written to or read from disk now; the scan goes on
struct MapDrifted {
  Error error;
};  ///< the camera revisits a place at a different position in the map, which contains it twice
struct ScanAdvice {
  Error error;
  /// Only for a depth scale that seems wrong: units per metre that would be plausible. The log has it
  /// already.
  std::optional<double> proposed_units_per_meter = {};
};  ///< a problem of the whole scan that the user can fix; the scan goes on
struct CameraLost {
  Error error;
};  ///< the live camera is gone; the scan waits for it, or ends where it did not come back
struct CameraReturned {
  Error error;
};  ///< the lost camera sends frames again
/// An operation took effect, and is on disk if the scan has a session.
struct Edited {
  ScanEdit edit;
  std::vector<RegionId> regions;  ///< the current regions that the operation affected
  bool is_automatic = false;      ///< an Operation that the scan did by itself
};
struct EditFailed {
  ScanEdit edit;
  Error error;
};  ///< an operation had no effect, or is not on disk
/// The session of the ended scan, or of an opened one, is ready for review.
struct ReviewOpened {
  bool can_refine = false;  ///< its refinement was skipped, or the scan was interrupted before it
};
struct KeyFrameLabeled {
  KeyFrameLabels labels;
};  ///< as LabelKeyFrame asked
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
  bool is_preview = false;  ///< of PreviewExport or SampleExport; an export may be going on
};
/// `total`: frames of the picture or the video.
struct RenderStepped {
  int done = 0, total = 0;
};
struct RenderFinished {
  std::filesystem::path file;
};
struct RenderFailed {
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
                 ObjectsMerged, ObjectRemoved, ObjectNamed, CatalogueFailed, MapFailed, MapDrifted,
                 ScanAdvice, CameraLost, CameraReturned, Edited, EditFailed, ReviewOpened, KeyFrameLabeled,
                 ExportPreviewed, ExportSampled, ExportStepped, ExportFinished, ExportFailed, RenderStepped,
                 RenderFinished, RenderFailed, FrameSkipped, ScanFailed, ScanFinished>;

/// Called on the worker's thread, in order; must return quickly (a window queues the event).
using ScanListener = std::function<void(const ScanEvent&)>;

}  // namespace scantrove
