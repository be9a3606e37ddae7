#pragma once
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/labeled_scan.h"
#include "core/dataset/scan_split.h"

namespace scantrove {

/// A scan of a project, which is opened when its turn comes.
struct ScanToExport {
  std::string name;
  std::function<Result<std::shared_ptr<LabeledScan>>()>
      open;  ///< called at least twice; one scan is open at a time
};

/// Scans that share a catalogue and its classes.
struct ProjectToExport {
  std::string name;
  std::vector<ScanToExport> scans;  ///< in any order; names differ
  ScanSplit split = {};
};

/// Writes several scans as one data set, atomically as exportDataset() does. Files of images have the prefix
/// of their scan (scanPrefixes), ids are unique over all scans, and categories are those of the catalogue.
/// - coco, yolo, voc, masks, labelstudio: one data set
/// - bop: one scene folder for each scan, models of all
/// - others: a folder for each scan, below train/, val/ and test/ if there is a split
/// `scans.json` lists the scans with prefix, split and images. Scans without anything to export are named in
/// the notes. Error: as exportDataset(); nothing to export in all scans; a scan of the split that does not
/// exist or has nothing to export.
[[nodiscard]] Result<ExportSummary> exportProject(ProjectToExport project, const ExportOptions& options,
                                                  const ExportProgressCallback& progress = {},
                                                  const std::stop_token& cancel = {});

}  // namespace scantrove
