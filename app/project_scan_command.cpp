#include "app/project_scan_command.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/child_scans.h"
#include "app/command.h"
#include "app/core_application.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/number_check.h"
#include "app/project_scan.h"
#include "app/scan_options.h"
#include "app/stop_signal.h"
#include "app/text_check.h"
#include "core/capture/open_input.h"
#include "core/project/recording_list.h"
#include "core/project/task_share.h"

namespace scantrove {
namespace {

struct ProjectScanCommand {
  std::string folder;
  std::vector<std::string> sources;
  std::string list;
  std::string task;
  int jobs = 1;
  bool json = false;
  bool skip_refinement = false;
  ScanOptions options;
  std::vector<std::string> passed_on;  ///< options of a scan, for processes of this program
};

bool isPathName(const std::string& source) {
  return !isCameraName(source) && source != "demo" && !source.starts_with("demo:");
}

/// Files and folders by their absolute path, so that a recording is known again from anywhere.
std::string sourceName(const std::string& source) {
  std::error_code failure;
  if (!std::filesystem::exists(source, failure)) return source;
  const std::filesystem::path path = std::filesystem::absolute(source).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).string();
}

std::optional<std::string> environmentVariable(const std::string& name) {
  const char* const value = std::getenv(name.c_str());
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

/// Arguments and list, in their order, each once, and of those this task's. Throws CLI::ValidationError.
std::vector<std::string> chosenSources(const ProjectScanCommand& command) {
  std::vector<std::string> sources = command.sources;
  if (!command.list.empty()) {
    const auto listed = readRecordingList(command.list, isPathName);
    if (!listed) throw CLI::ValidationError("--list", listed.error().message());
    sources.insert(sources.end(), listed->begin(), listed->end());
  }
  if (sources.empty())
    throw CLI::ValidationError("SOURCE", "is missing. Give recordings, or --list FILE with one a line");
  std::ranges::transform(sources, sources.begin(), sourceName);
  sources = withoutRepetitions(std::move(sources));
  if (command.task.empty()) return sources;
  const auto share = parseTaskShare(command.task, environmentVariable);
  if (!share) throw CLI::ValidationError("--task", share.error().message());
  return share->of(sources);
}

/// The given options of `sub` but those of the list as a whole.
std::vector<std::string> scanOptionsOf(const CLI::App& sub) {
  constexpr std::array<std::string_view, 6> kOfTheList{"PROJECT", "SOURCE", "--list",
                                                       "--task",  "--jobs", "--json"};
  std::vector<std::string> arguments;
  for (const CLI::Option* option : sub.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::ranges::count(kOfTheList, name) > 0) continue;
    if (option->get_items_expected_max() == 0) {
      arguments.push_back(name);
      continue;
    }
    for (const std::string& value : option->results()) arguments.push_back(name + '=' + value);
  }
  return arguments;
}

std::vector<RecordingOutcome> scanOneAfterTheOther(
    const Project& project, const std::vector<ScanRequest>& requests,
    const std::function<void(const RecordingOutcome&)>& on_end) {
  const KernelCacheUse kernels;
  listenForStop();
  std::vector<RecordingOutcome> outcomes;
  for (const ScanRequest& request : requests) {
    if (stopRequested()) {
      outcomes.emplace_back().source = request.source;
      continue;
    }
    outcomes.push_back(scanIntoProject(project, request));
    on_end(outcomes.back());
  }
  return outcomes;
}

Result<void> scanRecordings(const Project& project, const ProjectScanCommand& command,
                            const std::vector<ScanRequest>& requests) {
  const bool is_single = requests.size() == 1;
  const auto announce = [&](const RecordingOutcome& outcome) {
    if (outcome.kind == RecordingOutcome::Kind::failed) {
      // The error of the command says it where there is only one.
      if (!is_single)
        std::cerr << "scantrove: " << inLine(outcome.source) << ": " << forTerminal(outcome.reason) << '\n';
    } else if (!command.json) {
      std::cout << toLine(outcome) << std::endl;
    }
  };
  const auto argumentsFor = [&](const std::string& source) {
    std::vector<std::string> arguments{"project", "scan", project.folder.string(), source, "--json"};
    arguments.insert(arguments.end(), command.passed_on.begin(), command.passed_on.end());
    return arguments;
  };
  std::vector<RecordingOutcome> outcomes;
  if (command.jobs == 1 || is_single) {
    outcomes = scanOneAfterTheOther(project, requests, announce);
  } else {
    std::vector<std::string> sources;
    for (const ScanRequest& request : requests) sources.push_back(request.source);
    outcomes = runChildScans(sources, command.jobs, argumentsFor, announce);
  }
  if (command.json) {
    printJson(toJson(outcomes));
  } else {
    std::cout << toSummary(outcomes);
  }
  return checkOutcomes(outcomes);
}

void addOptions(CLI::App& sub, ProjectScanCommand& command) {
  sub.add_option("PROJECT", command.folder, "folder of the project")->required();
  sub.add_option("SOURCE", command.sources, kSourceHelp)->check(notEmpty("SOURCE"));
  sub.add_option("--list", command.list,
                 "a file with one SOURCE a line; '#' begins a comment, paths start at the file's folder")
      ->type_name("FILE");
  sub.add_option("--jobs", command.jobs, "number of recordings to scan at the same time (default: 1)")
      ->transform(wholeNumber(1))
      ->type_name("N");
  sub.add_option("--task", command.task,
                 "take every N-th recording, from number I on (1 to N); 'slurm': by the place of the\n"
                 "job in its Slurm array")
      ->type_name("I/N|slurm");
  sub.add_flag("--json", command.json, "the summary as JSON");
  sub.add_flag("--skip-refinement", command.skip_refinement,
               "skip the refinement; 'scantrove session refine' does it later");
  command.options.addTo(sub);
}

}  // namespace

void addProjectScan(CLI::App& parent, CommandJob& job) {
  auto command = std::make_shared<ProjectScanCommand>();
  CLI::App* sub = parent.add_subcommand(
      "scan",
      "Scan recordings into a project. Those scanned to their end before are skipped, as are those that\n"
      "another program scans now; stopped ones are continued");
  addOptions(*sub, *command);
  sub->callback([command, sub, &job] {
    command->passed_on = scanOptionsOf(*sub);
    std::vector<ScanRequest> requests;
    for (const std::string& source : chosenSources(*command)) {
      command->options.source = source;
      requests.push_back(command->options.toRequest());
      requests.back().skip_refinement = command->skip_refinement;
    }
    job = [command, requests]() -> Result<void> {
      const CoreApplication qt;
      const Result<Project> project = openProject(command->folder);
      if (!project) return fail(project.error());
      return scanRecordings(*project, *command, requests);
    };
  });
}

}  // namespace scantrove
