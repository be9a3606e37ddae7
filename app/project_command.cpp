#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <system_error>
#include <vector>

#include "app/command.h"
#include "app/core_application.h"
#include "app/frame_use.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/scan_options.h"
#include "app/scan_runner.h"
#include "app/session_list_command.h"
#include "app/stop_signal.h"
#include "app/text_check.h"
#include "core/catalogue/object_database.h"
#include "core/exchange/atomic_file.h"
#include "core/project/project.h"
#include "core/session/session_setup.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

struct ProjectCommand {
  std::string folder;
  std::string name;
  std::string database;
  bool json = false;
  std::vector<std::string> sources;
  bool skip_refinement = false;
  ScanOptions options;
};

/// Objects of the project's catalogue; both 0: there is none yet.
struct ObjectCounts {
  int all = 0, confirmed = 0;
};

Result<ObjectCounts> countObjects(const Project& project) {
  ObjectCounts counts;
  if (!mayCatalogueExist(project.catalogue)) return counts;
  const auto database = ObjectDatabase::openToRead(project.catalogue.string());
  if (!database) return fail(database.error());
  const auto objects = (*database)->objects();
  if (!objects) return fail(objects.error());
  for (const ObjectRecord& object : *objects) {
    ++counts.all;
    counts.confirmed += object.confirmed ? 1 : 0;
  }
  return counts;
}

Result<void> create(const ProjectCommand& command) {
  const Result<Project> project = createProject(command.folder, command.name, command.database);
  if (!project) return fail(project.error());
  std::cout << "project  " << inLine(project->name) << " in " << inLine(project->folder.string()) << '\n';
  return {};
}

Result<void> show(const Project& project, const ProjectCommand& command) {
  const Result<ObjectCounts> objects = countObjects(project);
  if (!objects) return fail(objects.error());
  const std::vector<SessionSummary> scans = listSessions(project.scansFolder());
  if (command.json) {
    printJson({{"name", project.name},
               {"path", project.folder.string()},
               {"catalogue", project.catalogue.string()},
               {"objects", objects->all},
               {"confirmed", objects->confirmed},
               {"scans", toJson(scans)}});
    return {};
  }
  std::cout << "project    " << inLine(project.name) << " in " << inLine(project.folder.string())
            << "\ncatalogue  " << objects->all << " objects, " << objects->confirmed
            << " confirmed\nscans      " << scans.size() << '\n';
  printSessions(scans);
  return {};
}

Result<void> list(const Project& project, const ProjectCommand& command) {
  const std::vector<SessionSummary> scans = listSessions(project.scansFolder());
  if (command.json) {
    printJson(toJson(scans));
    return {};
  }
  printSessions(scans);
  if (scans.empty()) std::cerr << "The project " << inLine(project.name) << " has no scans yet.\n";
  return {};
}

/// "2026-11-22 15.40.02", local time.
std::string secondOfDay() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm local{};
  ::localtime_r(&now, &local);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H.%M.%S", &local)};
}

/// Files and folders by their absolute path, so that a recording is known again from anywhere.
std::string sourceName(const std::string& source) {
  std::error_code failure;
  if (!fs::exists(source, failure)) return source;
  fs::path path = fs::absolute(source).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).string();
}

/// The project's scan of that source: the one that read it to the end, else the newest that could be
/// continued. Null: none.
const SessionSummary* scanOf(const std::vector<SessionSummary>& scans, const std::string& source) {
  const SessionSummary* found = nullptr;
  for (const SessionSummary& scan : scans) {
    if (!scan.damage.empty() || scan.source != source) continue;
    if (found == nullptr || (scan.read_to_end && !found->read_to_end)) found = &scan;
  }
  return found;
}

/// What became of the recordings of `project scan`.
struct ScanOutcomes {
  int scanned = 0, done_before = 0;
  std::vector<std::string> failures;  ///< a sentence each
};

/// `earlier`: a stopped scan to continue, or null.
Result<void> scanInto(const Project& project, ScanRequest request, const SessionSummary* earlier) {
  const std::string source = request.source;
  request.resume = earlier != nullptr;
  request.output_folder = request.resume
                              ? earlier->folder
                              : newScanFolder(project, secondOfDay(), fs::path(source).filename().string());
  request.database = project.catalogue.string();
  SCANTROVE_TRY(prepareOutputFolder(*request.output_folder));
  const SourceOptions options = request.source_options;
  const fs::path folder = *request.output_folder;
  const auto report = runToEnd(std::move(request));
  if (!report) {
    std::error_code ignored;
    fs::remove(folder, ignored);  // only if the scan left it empty
    return fail(report.error());
  }
  SCANTROVE_TRY(checkFramesWereUsed(*report, options, earlier != nullptr));
  std::cout << (earlier != nullptr ? "resumed  " : "scanned  ") << inLine(source) << ": "
            << report->frames.tracked << " of " << report->frames.read << " frames tracked, "
            << report->regions << " regions, " << report->objects.size() << " objects\n";
  return {};
}

Result<void> scanAll(const Project& project, const std::vector<ScanRequest>& requests) {
  SCANTROVE_TRY(prepareOutputFolder(project.scansFolder()));
  const KernelCacheUse kernels;
  ScanOutcomes outcomes;
  for (const ScanRequest& request : requests) {
    const std::vector<SessionSummary> scans = listSessions(project.scansFolder());
    const SessionSummary* earlier = scanOf(scans, request.source);
    if (earlier != nullptr && earlier->read_to_end) {
      std::cout << "skipped  " << inLine(request.source) << ": scanned before, as " << inLine(earlier->name)
                << '\n';
      ++outcomes.done_before;
      continue;
    }
    if (const Result<void> done = scanInto(project, request, earlier); !done) {
      outcomes.failures.push_back(done.error().message());
      std::cerr << "scantrove: " << forTerminal(outcomes.failures.back()) << '\n';
    } else {
      ++outcomes.scanned;
    }
    if (stopRequested()) break;
  }
  std::cout << "project  " << outcomes.scanned << " scanned, " << outcomes.done_before << " before, "
            << outcomes.failures.size() << " failed, of " << requests.size() << '\n';
  if (outcomes.failures.empty()) return {};
  return fail(std::to_string(outcomes.failures.size()) + " of " + std::to_string(requests.size()) +
                  " recordings could not be scanned; the reasons stand above.",
              "Run the same command again after mending them; what is scanned is skipped.");
}

using Work = Result<void> (*)(const Project&, const ProjectCommand&);

/// A subcommand that reads a project.
CLI::App* addReading(CLI::App& parent, CommandJob& job, const std::string& name, const std::string& help,
                     Work work) {
  auto command = std::make_shared<ProjectCommand>();
  CLI::App* sub = parent.add_subcommand(name, help);
  sub->add_option("PROJECT", command->folder, "folder of the project")->required();
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, work, &job] {
    job = [command, work]() -> Result<void> {
      const CoreApplication qt;
      const Result<Project> project = openProject(command->folder);
      if (!project) return fail(project.error());
      return work(*project, *command);
    };
  });
  return sub;
}

void addCreate(CLI::App& parent, CommandJob& job) {
  auto command = std::make_shared<ProjectCommand>();
  CLI::App* sub = parent.add_subcommand("create", "Make a project in a new or an empty folder");
  sub->add_option("DIR", command->folder, "folder of the project")->required();
  sub->add_option("--name", command->name, "name of the project (default: the folder's)");
  sub->add_option("--database", command->database,
                  "a PostgreSQL database as its catalogue (default: the file catalogue.sqlite)")
      ->type_name("URL");
  sub->callback([command, &job] { job = [command] { return create(*command); }; });
}

void addScan(CLI::App& parent, CommandJob& job) {
  auto command = std::make_shared<ProjectCommand>();
  CLI::App* sub = parent.add_subcommand("scan",
                                        "Scan recordings into a project, one after the other. Those scanned "
                                        "to their end before are skipped, stopped ones "
                                        "are continued");
  sub->add_option("PROJECT", command->folder, "folder of the project")->required();
  sub->add_option("SOURCE", command->sources, kSourceHelp)->required()->check(notEmpty("SOURCE"));
  sub->add_flag("--skip-refinement", command->skip_refinement,
                "skip the refinement; 'scantrove session refine' does it later");
  command->options.addTo(*sub);
  sub->callback([command, &job] {
    std::vector<ScanRequest> requests;
    for (const std::string& source : command->sources) {
      command->options.source = sourceName(source);
      requests.push_back(command->options.toRequest());
      requests.back().skip_refinement = command->skip_refinement;
    }
    job = [command, requests]() -> Result<void> {
      const CoreApplication qt;
      const Result<Project> project = openProject(command->folder);
      if (!project) return fail(project.error());
      return scanAll(*project, requests);
    };
  });
}

}  // namespace

void addProjectCommand(CLI::App& app, CommandJob& job) {
  CLI::App* group = app.add_subcommand("project", "Collect scans and their objects in one folder");
  group->require_subcommand(1);
  addCreate(*group, job);
  addReading(*group, job, "show", "Show a project: its catalogue and scans", show);
  addReading(*group, job, "list", "List the scans of a project, newest first", list);
  addScan(*group, job);
}

}  // namespace scantrove
