#include "core/session/output_owner.h"

#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "core/session/session_files.h"
#include "core/session/session_list.h"
#include "core/session/session_setup.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

bool holdsOurReport(const fs::path& folder) {
  const fs::path file = folder / "report.json";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  return report.is_object() && report.contains("source") && report.contains("device") &&
         report.contains("params") && report.contains("frames");
}

std::optional<fs::path> findResultFile(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {"trajectory.txt", "labels.json", "cloud.ply", "cloud.pcd", "report.json"}) {
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  }
  return std::nullopt;
}

/// The first folder of these names that is not empty.
std::optional<fs::path> findFilled(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const fs::path part = folder / name;
    std::error_code ignored;
    if (fs::is_directory(part, ignored) && !fs::is_empty(part, ignored)) return part;
  }
  return std::nullopt;
}

/// What a scan with these outputs would replace in the folder of an earlier scan.
std::optional<fs::path> findForeignResult(const fs::path& folder, const ScanResults& planned) {
  const ScanResults own = ownResults(folder);
  std::optional<fs::path> foreign;
  if (planned.files && !own.files) foreign = findResultFile(folder);
  if (!foreign && planned.label_images && !own.label_images)
    foreign = findFilled(folder, {"labels", "segments", "labels-final"});
  return foreign;
}

Result<void> refuse(const std::optional<fs::path>& foreign) {
  if (!foreign) return {};
  return fail(foreign->string() + " is not part of an earlier scan, and a new scan would use its place.",
              "Name another folder, or add --overwrite.");
}

}  // namespace

ScanResults ownResults(const fs::path& folder) {
  const SessionMetadata metadata = readSessionMetadata(folder);
  const auto has = [&](const char* key) {
    const auto found = metadata.find(key);
    return found != metadata.end() && !found->second.empty();
  };
  const bool has_report = holdsOurReport(folder);
  // Sessions of earlier versions, and scans without a session, do not record whether they wrote label
  // images.
  return {has(kResultsKey) || has_report, has(kLabelImagesKey) || (has_report && !has(kResultsKey))};
}

bool holdsEarlierScan(const fs::path& folder) {
  return SessionStore::isSession(folder) || holdsOurReport(folder);
}

Result<void> checkHoldsOnlyOurs(const fs::path& folder, const ScanResults& planned) {
  if (const std::optional<fs::path> foreign = findForeignFile(folder)) return refuse(foreign);
  if (holdsEarlierScan(folder)) return checkResultsAreOurs(folder, planned);
  // Nothing in it is ours.
  SCANTROVE_TRY(refuse(findResultFile(folder)));
  return refuse(findFilled(folder, {"labels", "segments", "labels-final", "map", "keyframes"}));
}

Result<void> checkResultsAreOurs(const fs::path& folder, const ScanResults& planned) {
  return refuse(findForeignResult(folder, planned));
}

}  // namespace scantrove
