#include "core/project/project.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/base/label_name.h"
#include "core/base/regular_file.h"
#include "core/database/server_address.h"
#include "core/exchange/atomic_file.h"
#include "core/session/session_list.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kProjectFile = "scantrove-project.json", *kCatalogueFile = "catalogue.sqlite";
/// Of earlier versions; other programs use the name, too.
constexpr const char* kOldProjectFile = "project.json";
/// The key that marks the file; its value is the version of the format.
constexpr const char *kVersionKey = "scantrove_project", *kServerKey = "catalogue";
/// 2: the catalogue may lie on a server. Projects without one are still written as version 1.
constexpr int kVersion = 2;
constexpr std::size_t kLargestFile_bytes = 1 << 20;
constexpr const char* kDefaultName = "Default project";
/// File systems allow 255 bytes; " (2)" and names of temporary files need some.
constexpr std::size_t kLongestScanName_bytes = 200;

/// The current folder for an empty path.
fs::path absoluteFolder(const fs::path& folder) {
  std::error_code failure;  // the current folder may be gone
  fs::path path = fs::absolute(folder.empty() ? "." : folder, failure).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

bool isDefaultFolder(const fs::path& folder) {
  return absoluteFolder(folder) == absoluteFolder(defaultScansFolder()).parent_path();
}

tl::unexpected<Error> damaged(const fs::path& file) {
  return fail(file.string() + " is damaged: it is no project of Scantrove.",
              "Restore it from a copy, or create a project in another folder.");
}

Project projectIn(const fs::path& folder, std::string name, const std::string& server = {}) {
  return {folder, std::move(name), server.empty() ? folder / kCatalogueFile : fs::path(server)};
}

Result<Project> projectFrom(const fs::path& file, const fs::path& folder) {
  const Result<std::string> text = readFile(file, kLargestFile_bytes);
  if (!text) return fail(text.error());
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains(kVersionKey) || !json.at(kVersionKey).is_number_integer())
    return damaged(file);
  if (json.at(kVersionKey).get<std::int64_t>() > kVersion) {
    return fail("The project " + folder.string() + " was written by a newer version of Scantrove.",
                "Update Scantrove.");
  }
  const auto name = json.find("name");
  if (name == json.end() || !name->is_string()) return damaged(file);
  const Result<std::string> checked = checkedProjectName(name->get<std::string>());
  if (!checked) return damaged(file);
  std::string server;
  if (const auto catalogue = json.find(kServerKey); catalogue != json.end()) {
    if (!catalogue->is_string() || !isServerAddress(catalogue->get<std::string>())) return damaged(file);
    server = catalogue->get<std::string>();
    SCANTROVE_TRY(checkCatalogueName(server));
  }
  return projectIn(folder, checked->empty() ? folder.filename().string() : *checked, server);
}

/// The file of the project in `folder`; none: it has none.
fs::path projectFileIn(const fs::path& folder) {
  std::error_code failure;
  for (const char* name : {kProjectFile, kOldProjectFile}) {
    if (fs::is_regular_file(folder / name, failure)) return folder / name;
  }
  return {};
}

bool isEmptyFolder(const fs::path& folder) {
  std::error_code failure;
  return fs::is_directory(folder, failure) && fs::is_empty(folder, failure) && !failure;
}

/// Cuts UTF-8 text between characters.
void shorten(std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return;
  const auto continues = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; };
  while (bytes > 0 && continues(text[bytes])) --bytes;
  text.resize(bytes);
}

std::string usableTitle(std::string title) {
  constexpr std::string_view kRefused = "/\\:*?\"<>|";
  std::ranges::replace_if(
      title,
      [&](char letter) {
        return static_cast<unsigned char>(letter) < ' ' || kRefused.find(letter) != std::string_view::npos;
      },
      '-');
  return title.empty() ? "scan" : title;
}

}  // namespace

bool isProjectFolder(const fs::path& folder) {
  const fs::path path = absoluteFolder(folder);
  return isProjectFile(path / kProjectFile) || isProjectFile(path / kOldProjectFile) || isDefaultFolder(path);
}

bool isProjectFile(const fs::path& file) {
  std::error_code failure;
  if (!fs::is_regular_file(file, failure)) return false;
  if (file.filename() == kProjectFile) return true;
  if (file.filename() != kOldProjectFile) return false;
  const Result<std::string> text = readFile(file, kLargestFile_bytes);
  return text && text->find(kVersionKey) != std::string::npos;
}

Project defaultProject() {
  return projectIn(absoluteFolder(defaultScansFolder()).parent_path(), kDefaultName);
}

Result<Project> openProject(const fs::path& folder) {
  const fs::path path = absoluteFolder(folder);
  std::error_code failure;
  const fs::path file = projectFileIn(path);
  if (file.empty()) {
    if (isDefaultFolder(path)) return defaultProject();
    if (!fs::is_directory(path, failure)) {
      return fail("There is no folder " + path.string() + ".",
                  "'scantrove project create " + path.string() + "' makes a project there.");
    }
    return fail(path.string() + " is not a project: it has no " + kProjectFile + ".",
                "Give a project's folder, or make one with 'scantrove project create DIR'.");
  }
  return projectFrom(file, path);
}

Result<Project> createProject(const fs::path& folder, const std::string& name, const std::string& server) {
  const Result<std::string> checked = checkedProjectName(name);
  if (!checked) return fail(checked.error());
  if (!server.empty() && !isServerAddress(server)) {
    return fail(
        "A project keeps its catalogue in its own folder or on a PostgreSQL server, not in " + server + ".",
        "Leave --database out, or give an address: postgresql://USER@HOST/DATABASE.");
  }
  SCANTROVE_TRY(checkCatalogueName(server));
  const fs::path path = absoluteFolder(folder);
  const Project project = projectIn(path, checked->empty() ? path.filename().string() : *checked, server);
  std::error_code failure;
  if (isProjectFolder(project.folder))
    return fail(project.folder.string() + " is a project already.", "Open it, or give another folder.");
  if (fs::exists(project.folder, failure) && !isEmptyFolder(project.folder)) {
    return fail(project.folder.string() + " is not an empty folder.",
                "Give a new or an empty folder for the project.");
  }
  SCANTROVE_TRY(prepareOutputFolder(project.folder));
  SCANTROVE_TRY(prepareOutputFolder(project.scansFolder()));
  Json json{{kVersionKey, server.empty() ? 1 : kVersion}, {"name", project.name}};
  if (!server.empty()) json[kServerKey] = server;
  SCANTROVE_TRY(writeFileAtomically(project.folder / kProjectFile,
                                    json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"));
  return project;
}

Result<Project> projectOfScan(const fs::path& folder) {
  return openProject(absoluteFolder(folder).parent_path().parent_path());
}

Project projectOfCatalogue(const fs::path& catalogue) {
  if (isServerAddress(catalogue.string())) return {defaultProject().folder, catalogue.string(), catalogue};
  std::error_code failure;
  const fs::path file = fs::absolute(catalogue, failure).lexically_normal();
  if (const Result<Project> project = openProject(file.parent_path()); project && project->catalogue == file)
    return *project;
  return {defaultProject().folder, file.filename().string(), file};
}

fs::path newScanFolder(const Project& project, const std::string& day, const std::string& title) {
  std::string name = usableTitle(title);
  shorten(name, kLongestScanName_bytes - std::min(kLongestScanName_bytes - 1, day.size() + 1));
  const std::string base = day + " " + name;
  fs::path folder = project.scansFolder() / base;
  std::error_code failure;
  for (int copy = 2; fs::exists(folder, failure); ++copy)
    folder = project.scansFolder() / (base + " (" + std::to_string(copy) + ")");
  return folder;
}

Result<fs::path> createScanFolder(const Project& project, const std::string& day, const std::string& title) {
  while (true) {
    fs::path folder = newScanFolder(project, day, title);
    std::error_code failure;
    if (fs::create_directory(folder, failure)) return folder;
    if (failure) {
      return fail("Cannot create " + folder.string() + ": " + failure.message() + ".",
                  "Give write permission to the project's folder, or use a copy of the project.");
    }
  }
}

}  // namespace scantrove
