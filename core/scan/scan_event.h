#pragma once
#include <algorithm>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/export_sample.h"
#include "core/scan/scan_command.h"
#include "core/scan/scan_report.h"
#include "core/scan/scan_state.h"

namespace scantrove {

// What a scan, or the review of its session, reports while it runs. None is lost, and they come in order.

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

/// Called on the worker's thread, in order; returns quickly (a window queues the event).
using ScanListener = std::function<void(const ScanEvent&)>;

}  // namespace scantrove
