#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// The report with the keys that the command line promises for report.json; times in ms, memory in MiB.
[[nodiscard]] nlohmann::ordered_json reportToJson(const ScanReport& report);

/// Writes it as report.json; beside, then renamed. That of a refinement replaces only what it found in the
/// report that is there. Error: names `path`.
Result<void> writeReport(const std::filesystem::path& path, const ScanReport& report);

}  // namespace scantrove
