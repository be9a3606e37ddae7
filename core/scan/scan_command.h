#pragma once
#include <optional>
#include <variant>

#include "core/dataset/dataset_export.h"
#include "core/editing/operation.h"
#include "core/scan/scan_request.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// Takes the newest operation back, or does it again.
struct UndoEdit {};
struct RedoEdit {};
using ScanEdit = std::variant<Operation, UndoEdit, RedoEdit>;

// What window and command line ask of a ScanWorker. What ends a scan or an export acts at once; the rest is
// done in order, between two frames or in an open session. A comment says which events follow.

/// Ends the present scan or review, after the edits that were posted before, then does `request`.
/// StateChanged and, in the end, ScanFinished or ScanFailed.
struct StartScan {
  ScanRequest request;
};
struct PauseScan {};
struct ResumeScan {};
struct StepScan {};   ///< one frame while paused
struct StopScan {};   ///< ends the scan cleanly: results are written. ScanFinished
struct CloseScan {};  ///< the same without a refinement, and no session stays open
/// The scan is not refined, or no further; it can be done later.
struct SkipRefinement {};
/// A person changes regions. Edited or EditFailed; the latter when no scan and no session is open.
struct EditRegions {
  ScanEdit edit;
};
/// Shows a key frame of the open session.
struct ShowKeyFrame {
  int place = 0;  ///< in ScanSnapshot::key_frames
};
/// What a data set would hold. ExportPreviewed, or ExportFailed as for all exports when no session is open.
struct PreviewExport {
  ExportOptions options;
};
/// One image of the data set. ExportSampled or ExportFailed.
struct SampleExport {
  ExportOptions options;
  std::optional<int> place;  ///< among its images; none: the one in the middle
};
/// ExportStepped, then ExportFinished or ExportFailed.
struct ExportDataset {
  ExportOptions options;
};
struct CancelExport {};
/// The catalogue was edited. Frames see that by themselves; this is for a paused scan.
struct FollowCatalogue {};
/// Replaces the parameters before the next frame (those of fusion need a new scan). The frame that a paused
/// scan, or an open session, shows is segmented again: of ScanSnapshot only `segments` changes.
struct SetParams {
  ScanParams params;
};

using ScanCommand = std::variant<StartScan, PauseScan, ResumeScan, StepScan, StopScan, CloseScan,
                                 SkipRefinement, EditRegions, ShowKeyFrame, PreviewExport, SampleExport,
                                 ExportDataset, CancelExport, FollowCatalogue, SetParams>;

}  // namespace scantrove
