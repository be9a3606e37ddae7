#include "core/session/session_setup.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "core/base/text.h"
#include "core/database/server_address.h"
#include "core/session/param_registry.h"
#include "core/session/row_checks.h"

namespace scantrove {

namespace fs = std::filesystem;

namespace {

/// Whether `file` lies beside the folder of scans that holds `folder`, also through all links.
bool isOfSameProject(const fs::path& file, const fs::path& folder) {
  std::error_code failure;
  const fs::path scans = fs::weakly_canonical(folder, failure).parent_path();
  return !failure && scans.filename() == "scans" &&
         fs::weakly_canonical(file, failure).parent_path() == scans.parent_path() && !failure;
}

}  // namespace

std::string storedDatabaseName(const std::string& database, const fs::path& folder) {
  if (isServerAddress(database)) return withoutPassword(database);
  if (database.empty()) return database;
  const fs::path file = fs::absolute(database).lexically_normal();
  const fs::path from_folder = file.lexically_relative(fs::absolute(folder).lexically_normal());
  const bool is_in_folder = !from_folder.empty() && *from_folder.begin() != "..";
  return (is_in_folder || isOfSameProject(file, folder) ? from_folder : file).string();
}

fs::path databaseFileOf(const SessionSetup& setup, const fs::path& folder) {
  if (setup.database.empty() || isServerAddress(setup.database)) return setup.database;
  const fs::path kept = setup.database;
  std::error_code ignored;
  // Sessions of the first version store the path as typed; and folders may be moved with their catalogue.
  for (const fs::path& file : {folder / kept, kept, folder / kept.filename()}) {
    if (fs::exists(file, ignored)) return file;
  }
  return folder / kept;
}

bool mayCatalogueExist(const fs::path& catalogue) {
  std::error_code ignored;
  return isServerAddress(catalogue.string()) || fs::is_regular_file(catalogue, ignored);
}

std::string originToText(const Eigen::Vector3d& origin_m) {
  std::string text;
  for (const double value : origin_m) text += (text.empty() ? "" : " ") + std::to_string(std::llround(value));
  return text;
}

SessionMetadata metadataOf(const SessionSetup& setup) {
  std::string params;
  for (const ParamInfo& info : paramRegistry()) params += info.key + "=" + info.text(setup.params) + "\n";
  const Intrinsics& K = setup.K;
  return {{"source", setup.source},
          {"camera", nlohmann::json{{"K", {K.fx, K.fy, K.cx, K.cy}}, {"size", {K.width, K.height}}}.dump()},
          {"params", params},
          {"database", setup.database},
          {kOriginKey, originToText(setup.origin_m)},
          {kPosesKey, setup.poses}};
}

Result<SessionSetup> setupFrom(const SessionMetadata& metadata) {
  const auto valueOf = [&](const char* name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? std::string() : found->second;
  };
  SessionSetup setup;
  setup.source = valueOf("source");
  setup.database = valueOf("database");
  setup.poses = valueOf(kPosesKey);
  try {
    const nlohmann::json camera = nlohmann::json::parse(valueOf("camera"));
    const nlohmann::json& K = camera.at("K");
    setup.K = {K.at(0).get<float>(),
               K.at(1).get<float>(),
               K.at(2).get<float>(),
               K.at(3).get<float>(),
               camera.at("size").at(0).get<int>(),
               camera.at("size").at(1).get<int>()};
  } catch (const nlohmann::json::exception&) {
    return fail("The session does not say what camera it was scanned with.",
                "It broke off before its first frame was kept, or is damaged.");
  }
  if (!rows::isPlausible(setup.K)) {
    return fail("The session is damaged: no camera can have the intrinsics and the image size that it names.",
                "Restore session.sqlite from a copy if there is one.");
  }
  if (const auto origin = parseNumbers(valueOf(kOriginKey)); origin && origin->size() == 3)
    setup.origin_m = Eigen::Vector3d(origin->data());
  std::istringstream lines(valueOf("params"));
  for (std::string line; std::getline(lines, line);) {
    // Parameters unknown to this program are ignored.
    std::string setting = line;
    std::erase(setting, '"');
    static_cast<void>(applySetting(setup.params, setting));
  }
  return setup;
}

}  // namespace scantrove
