#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/dataset/dataset_export.h"
#include "core/editing/operation.h"
#include "core/picture/render_file.h"
#include "core/scan/scan_request.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// Undoes the newest operation, or redoes it.
struct UndoEdit {};
struct RedoEdit {};
using ScanEdit = std::variant<Operation, UndoEdit, RedoEdit>;

// Commands of window and command line to a ScanWorker. Commands that end a scan or an export act at once.
// The others are executed in order, between two frames or in an open session. A comment names the resulting
// events.

/// Ends the current scan or review after the edits posted before, then executes `request`. StateChanged
/// and, at the end, ScanFinished or ScanFailed.
struct StartScan {
  ScanRequest request;
};
struct PauseScan {};
struct ResumeScan {};
struct StepScan {};   ///< one frame while paused
struct StopScan {};   ///< ends the scan regularly: results are written. ScanFinished
struct CloseScan {};  ///< the same without refinement, and no session stays open
/// Skips or stops the refinement, which can be done later.
struct SkipRefinement {};
/// A user edits regions. Edited or EditFailed; the latter when no scan and no session is open.
struct EditRegions {
  ScanEdit edit;
};
/// Shows a key frame of the open session.
struct ShowKeyFrame {
  int index = 0;  ///< index in ScanSnapshot::key_frames
};
/// The image of a key frame of the open session with its regions, at full resolution. KeyFrameLabeled or
/// MapFailed.
struct LabelKeyFrame {
  int index = 0;  ///< as in ShowKeyFrame
};
/// The expected content of a data set. ExportPreviewed, or ExportFailed as for all exports when no session
/// is open.
struct PreviewExport {
  ExportOptions options;
};
/// One image of the data set. ExportSampled or ExportFailed.
struct SampleExport {
  ExportOptions options;
  std::optional<int> index;  ///< among its images; none: the middle one
};
/// ExportStepped, then ExportFinished or ExportFailed.
struct ExportDataset {
  ExportOptions options;
};
/// Draws the open session into a new file. RenderStepped, then RenderFinished or RenderFailed.
struct RenderPicture {
  RenderOptions options;
};
/// Exports the project in which the open session lies, as ExportDataset.
struct ExportProject {
  ExportOptions options;
  std::vector<std::string> scans;  ///< names of their folders
  ScanSplit split;
};
struct CancelExport {};  ///< and RenderPicture
/// The catalogue was edited. Frames detect that themselves; this is for a paused scan.
struct ApplyCatalogueChanges {};
/// Replaces the parameters before the next frame (fusion parameters need a new scan). The frame shown by a
/// paused scan or an open session is segmented again: only `segments` of ScanSnapshot changes.
struct SetParams {
  ScanParams params;
};

using ScanCommand =
    std::variant<StartScan, PauseScan, ResumeScan, StepScan, StopScan, CloseScan, SkipRefinement, EditRegions,
                 ShowKeyFrame, LabelKeyFrame, PreviewExport, SampleExport, ExportDataset, ExportProject,
                 RenderPicture, CancelExport, ApplyCatalogueChanges, SetParams>;

}  // namespace scantrove
