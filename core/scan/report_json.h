#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// The report with the documented keys of report.json; times in ms, memory in MiB.
[[nodiscard]] nlohmann::ordered_json reportToJson(const ScanReport& report);

/// Writes report.json through a temporary file. A refinement replaces only its own results in the existing
/// report. Error: names `path`.
Result<void> writeReport(const std::filesystem::path& path, const ScanReport& report);

}  // namespace scantrove
