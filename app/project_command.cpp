#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/command.h"
#include "app/core_application.h"
#include "app/json_output.h"
#include "app/project_scan_command.h"
#include "app/session_list_command.h"
#include "core/catalogue/object_database.h"
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

}  // namespace

void addProjectCommand(CLI::App& app, CommandJob& job) {
  CLI::App* group = app.add_subcommand("project", "Collect scans and their objects in one folder");
  group->require_subcommand(1);
  addCreate(*group, job);
  addReading(*group, job, "show", "Show a project: its catalogue and scans", show);
  addReading(*group, job, "list", "List the scans of a project, newest first", list);
  addProjectScan(*group, job);
}

}  // namespace scantrove
