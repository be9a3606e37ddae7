#include "core/scan/output_owner.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "core/session/session_files.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// A result's name in a folder that no scan of ours wrote, or a folder of that name with something in it.
std::optional<fs::path> findForeignResult(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {"trajectory.txt", "labels.json", "cloud.ply", "cloud.pcd", "report.json"}) {
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  }
  for (const char* name : {"labels", "segments", "labels-final", "map", "keyframes"}) {
    const fs::path part = folder / name;
    if (fs::is_directory(part, ignored) && !fs::is_empty(part, ignored)) return part;
  }
  return std::nullopt;
}

}  // namespace

bool holdsOurReport(const fs::path& folder) {
  const fs::path file = folder / "report.json";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  return report.is_object() && report.contains("source") && report.contains("device") &&
         report.contains("params") && report.contains("frames");
}

bool holdsEarlierScan(const fs::path& folder) {
  return SessionStore::isSession(folder) || holdsOurReport(folder);
}

Result<void> checkHoldsOnlyOurs(const fs::path& folder) {
  std::optional<fs::path> foreign = findForeignFile(folder);
  if (!foreign && !holdsEarlierScan(folder)) foreign = findForeignResult(folder);
  if (!foreign) return {};
  return fail(foreign->string() + " is not part of an earlier scan, and a new scan would use its place.",
              "Name another folder, or add --overwrite.");
}

}  // namespace scantrove
