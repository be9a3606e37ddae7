#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "app/command.h"
#include "app/core_application.h"
#include "app/export_choice_options.h"
#include "app/export_report.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/stop_signal.h"
#include "core/dataset/catalogue_export.h"
#include "core/dataset/centered_mesh.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/project_export.h"
#include "core/project/project.h"
#include "core/project/project_scans.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

struct ExportCommand {
  std::string folder, project, database, out, format, device, license;
  bool all_frames = false, background = false, include_unfit = false, centered = false, json = false;
  bool checked_only = false, dry_run = false, texture = false;
  int texture_size_px = kMaxTexture_px;
  ExportChoiceOptions choices;
};

Result<ExportOptions> optionsOf(const ExportCommand& command) {
  const Result<DatasetFormat> format = parseDatasetFormat(command.format);
  if (!format) return fail(format.error());
  ExportOptions options;
  options.format = *format;
  options.folder = command.out;
  options.all_frames = command.all_frames;
  options.background = command.background;
  options.include_unfit = command.include_unfit;
  options.license = command.license;
  options.checked_only = command.checked_only;
  options.choices = command.choices.choices();
  options.dry_run = command.dry_run;
  options.texture_size_px = command.texture ? command.texture_size_px : 0;
  return options;
}

/// Prints progress on stderr in steps of ten percent. Ctrl+C cancels the export.
class ExportProgressPrinter {
 public:
  ExportProgressPrinter() {
    listenForStop();
    setAtStop(AtStop::unfinished);  // the next export to this folder removes partial output
  }
  void operator()(const ExportProgress& progress) {
    if (stopRequested()) stop_.request_stop();
    const int percent = progress.total > 0 ? 10 * (10 * progress.done / progress.total) : 0;
    if (percent != std::exchange(last_percent_, percent))
      std::cerr << percent << " % " << inLine(progress.what) << '\n';
  }
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  int last_percent_ = -1;
};

long megabytesOf(std::uint64_t bytes) { return std::lround(static_cast<double>(bytes) / 1e6); }

void printMessages(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) std::cerr << "scantrove: " << inLine(message) << '\n';
}

Result<void> exportObjects(const ExportCommand& command) {
  ExportProgressPrinter printer;
  const auto summary = exportCatalogue(command.database, command.out, std::ref(printer), printer.token());
  if (!summary) return fail(summary.error());
  printMessages(summary->skipped);
  if (command.json) {
    printJson({{"folder", summary->folder.string()},
               {"objects", summary->objects},
               {"views", summary->views},
               {"bytes", summary->bytes},
               {"skipped", summary->skipped}});
    return {};
  }
  std::cout << "objects  " << summary->objects << " objects, " << summary->views << " views, "
            << megabytesOf(summary->bytes) << " MB\nresults  " << inLine(summary->folder.string()) << '\n';
  return {};
}

/// Prints the result of an export, its messages to stderr.
void printResult(const ExportSummary& summary, const ExportCommand& command) {
  printMessages(summary.skipped);
  printMessages(summary.notes);
  if (summary.unfit > 0)
    std::cerr << "scantrove: " << summary.unfit
              << " unfit frames were left out; --include-unfit-frames exports them.\n";
  if (command.json) {
    printJson(exportToJson(summary, command.format, command.dry_run));
  } else {
    printExport(summary, command.format, command.dry_run);
  }
}

Result<void> exportSession(const ExportCommand& command) {
  const Result<ExportOptions> options = optionsOf(command);
  if (!options) return fail(options.error());
  const KernelCacheUse kernels;
  auto session = OpenSession::open(command.folder, command.device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages())
    std::cerr << "scantrove: " << inLine(damage) << '\n';
  SessionScan scan(**session);
  ExportProgressPrinter printer;
  const auto exportScan = command.centered ? exportCenteredMesh : exportDataset;
  const auto summary = exportScan(scan, *options, std::ref(printer), printer.token());
  if (!summary) return fail(summary.error());
  if ((*session)->missingCatalogue())
    std::cerr << "scantrove: " << inLine((*session)->missingCatalogue()->message()) << '\n';
  printResult(*summary, command);
  return {};
}

Result<void> exportWholeProject(const ExportCommand& command) {
  const Result<ExportOptions> options = optionsOf(command);
  if (!options) return fail(options.error());
  const Result<Project> project = openProject(command.project);
  if (!project) return fail(project.error());
  const KernelCacheUse kernels;
  std::set<std::string> warned;
  const auto warn = [&](const std::string& sentence) {
    if (warned.insert(sentence).second) std::cerr << "scantrove: " << inLine(sentence) << '\n';
  };
  auto scans = scansToExport(*project, command.choices.scanNames(), command.device, warn);
  if (!scans) return fail(scans.error());
  ExportProgressPrinter printer;
  const auto summary = exportProject({project->name, std::move(*scans), command.choices.scanSplit()},
                                     *options, std::ref(printer), printer.token());
  if (!summary) return fail(summary.error());
  printResult(*summary, command);
  return {};
}

/// Throws CLI::ValidationError.
void checkExport(const ExportCommand& command) {
  const bool is_catalogue = !command.database.empty(), is_project = !command.project.empty();
  const int sources = (command.folder.empty() ? 0 : 1) + (is_catalogue ? 1 : 0) + (is_project ? 1 : 0);
  if (sources != 1) {
    throw CLI::ValidationError("DIR",
                               "is a session, --project a project, --database a catalogue. Give one of them");
  }
  if (is_catalogue &&
      (!command.format.empty() || command.all_frames || command.background || command.include_unfit ||
       command.checked_only || !command.license.empty() || command.dry_run || command.choices.isAny())) {
    throw CLI::ValidationError(
        "--database",
        "cannot be combined with --format, --all-frames, --background, "
        "--include-unfit-frames, --checked-only, --license, --dry-run or choices of labels and "
        "scans");
  }
  if (command.centered && (command.format != "mesh" || is_project))
    throw CLI::ValidationError("--centred", "needs --format mesh and the folder of one session");
  if (command.texture && command.format != "mesh")
    throw CLI::ValidationError("--texture", "needs --format mesh");
  if (!is_catalogue && command.format.empty())
    throw CLI::ValidationError("--format", "is required to export a session or a project");
  if (command.out.empty() && !command.dry_run)
    throw CLI::ValidationError("--out", "is required, unless with --dry-run");
  if (!is_catalogue) command.choices.check(is_project, command.format);
}

}  // namespace

void addExportCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand("export", "Export a data set of a scan, a project or a catalogue");
  sub->add_option("DIR", command->folder, "folder of the session");
  sub->add_option("--project", command->project, "instead of DIR: export the scans of this project together")
      ->type_name("PROJECT");
  sub->add_option("--database", command->database,
                  "instead of DIR: export the views of all objects of this catalogue")
      ->type_name("FILE");
  sub->add_option("--format", command->format, "format of the data set")
      ->check(CLI::IsMember(datasetFormatNames()))
      ->type_name("coco|bop|yolo|masks|voc|labelstudio|boxes|foundationpose|ply|pcd|mesh|tum|scannet");
  sub->add_option("--out", command->out,
                  "folder for the data set: a new or empty one, or that of an earlier data set of the "
                  "same format, which is replaced if nobody has changed it")
      ->type_name("DIR2");
  sub->add_flag("--all-frames", command->all_frames, "export all stored frames, not only key frames");
  sub->add_flag("--checked-only", command->checked_only, "export only key frames whose review is checked");
  sub->add_flag("--background", command->background, "include background and rejected regions");
  sub->add_flag("--include-unfit-frames,--include-blurred", command->include_unfit,
                "include frames that are blurred, or whose depth and colour do not fit");
  sub->add_flag("--centred,--centered", command->centered,
                "with --format mesh: centre each object at the origin and write the offset to a file");
  CLI::Option* texture = sub->add_flag("--texture", command->texture,
                                       "with --format mesh: textures from the colour images of key frames");
  sub->add_option("--texture-size", command->texture_size_px, "width and height of a texture at most")
      ->needs(texture)
      ->check(CLI::Range(kMinTexture_px, kMaxTexture_px))
      ->type_name("PIXELS")
      ->capture_default_str();
  sub->add_option("--license", command->license, "licence of the data set, for its README and LICENSE.txt")
      ->type_name("TEXT");
  command->choices.addTo(*sub);
  sub->add_flag("--dry-run", command->dry_run, "count images, instances and pixels, and write nothing");
  sub->add_flag("--json", command->json, "print the summary with the counts of each class as JSON");
  sub->add_option("--device", command->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([command, &job] {
    checkExport(*command);
    job = [command]() -> Result<void> {
      const CoreApplication qt;
      if (!command->database.empty()) return exportObjects(*command);
      return command->project.empty() ? exportSession(*command) : exportWholeProject(*command);
    };
  });
}

}  // namespace scantrove
