#pragma once
#include <string>

#include "core/base/result.h"
#include "core/dataset/export_job.h"

namespace scantrove {

/// Writes `scans.json` of a project's data set: `[{"scan", "prefix", "folder", "split", "images"}]`, null for
/// what a format does not have. Nothing for a data set of one scan.
[[nodiscard]] Result<void> writeScanList(ExportJob& job);

/// The place of a scan in the data set: the folder of its files, or the prefix of their names.
[[nodiscard]] std::string placeInDataset(const DatasetPart& part, DatasetFormat format);

}  // namespace scantrove
