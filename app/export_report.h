#pragma once
#include <string>

#include "app/json_output.h"
#include "core/dataset/dataset_export.h"

namespace scantrove {

/// The summary of an export as JSON, with the counts of each class and split.
[[nodiscard]] Json exportToJson(const ExportSummary& summary, const std::string& format, bool is_dry_run);

/// Prints it as text: one line, the folder, and a table of classes (for each split, if there are any).
void printExport(const ExportSummary& summary, const std::string& format, bool is_dry_run);

}  // namespace scantrove
