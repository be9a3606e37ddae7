#include <cmath>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "app/command.h"
#include "app/core_application.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/stop_signal.h"
#include "core/dataset/catalogue_export.h"
#include "core/dataset/centered_mesh.h"
#include "core/dataset/dataset_export.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

struct ExportCommand {
  std::string folder, database, out, format, device, license;
  bool all_frames = false, background = false, include_unfit = false, centered = false, json = false,
       checked_only = false;
};

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

Json toJson(const ExportSummary& summary, const std::string& format) {
  Json classes = Json::array();
  for (const ClassCount& count : summary.classes) {
    classes.push_back({{"name", count.name},
                       {"images", count.images},
                       {"instances", count.instances},
                       {"pixels", count.pixels}});
  }
  return {{"format", format},
          {"folder", summary.folder.string()},
          {"images", summary.images},
          {"regions", summary.regions},
          {"annotations", summary.annotations},
          {"points", summary.points},
          {"faces", summary.faces},
          {"bytes", summary.bytes},
          {"unfit", summary.unfit},
          {"skipped", summary.skipped},
          {"notes", summary.notes},
          {"classes", std::move(classes)}};
}

void printSummary(const ExportSummary& summary, const std::string& format) {
  std::cout << format << "     " << summary.images << " images, " << summary.regions << " regions, "
            << summary.annotations << " annotations";
  if (!summary.classes.empty()) std::cout << " of " << summary.classes.size() << " classes";
  if (summary.points > 0) std::cout << ", " << summary.points << " points";
  if (summary.faces > 0) std::cout << ", " << summary.faces << " faces";
  std::cout << ", " << megabytesOf(summary.bytes) << " MB\nresults  " << inLine(summary.folder.string())
            << '\n';
}

Result<void> exportSession(const ExportCommand& command) {
  const Result<DatasetFormat> format = parseDatasetFormat(command.format);
  if (!format) return fail(format.error());
  const KernelCacheUse kernels;
  auto session = OpenSession::open(command.folder, command.device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages())
    std::cerr << "scantrove: " << inLine(damage) << '\n';
  SessionScan scan(**session);
  ExportProgressPrinter printer;
  const auto exportScan = command.centered ? exportCenteredMesh : exportDataset;
  const ExportOptions options{
      *format,         command.out,         command.all_frames, command.background, command.include_unfit,
      command.license, command.checked_only};
  const auto summary = exportScan(scan, options, std::ref(printer), printer.token());
  if (!summary) return fail(summary.error());
  if ((*session)->missingCatalogue())
    std::cerr << "scantrove: " << inLine((*session)->missingCatalogue()->message()) << '\n';
  printMessages(summary->skipped);
  printMessages(summary->notes);
  if (summary->unfit > 0)
    std::cerr << "scantrove: " << summary->unfit
              << " unfit frames were left out; --include-unfit-frames exports them.\n";
  if (command.json) {
    printJson(toJson(*summary, command.format));
  } else {
    printSummary(*summary, command.format);
  }
  return {};
}

}  // namespace

void addExportCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand("export", "Export a data set of a scan or a catalogue");
  sub->add_option("DIR", command->folder, "folder of the session");
  sub->add_option("--database", command->database,
                  "instead of DIR: export the views of all objects of this catalogue")
      ->type_name("FILE");
  sub->add_option("--format", command->format, "format of the data set")
      ->check(CLI::IsMember(datasetFormatNames()))
      ->type_name("coco|bop|yolo|masks|voc|labelstudio|boxes|foundationpose|ply|pcd|mesh|tum|scannet");
  sub->add_option("--out", command->out, "folder for the data set; must be empty or not exist")
      ->required()
      ->type_name("DIR2");
  sub->add_flag("--all-frames", command->all_frames, "export all stored frames, not only key frames");
  sub->add_flag("--checked-only", command->checked_only, "export only key frames whose review is checked");
  sub->add_flag("--background", command->background, "include background and rejected regions");
  sub->add_flag("--include-unfit-frames,--include-blurred", command->include_unfit,
                "include frames that are blurred, or whose depth and colour do not fit");
  sub->add_flag("--centred,--centered", command->centered,
                "with --format mesh: centre each object at the origin and write the offset to a file");
  sub->add_option("--license", command->license, "licence of the data set, for its README and LICENSE.txt")
      ->type_name("TEXT");
  sub->add_flag("--json", command->json, "print the summary with the counts of each class as JSON");
  sub->add_option("--device", command->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([command, &job] {
    const bool is_catalogue = !command->database.empty();
    if (is_catalogue != command->folder.empty()) {
      throw CLI::ValidationError("DIR", "is a session, --database a catalogue. Give one of them");
    }
    if (is_catalogue && (!command->format.empty() || command->all_frames || command->background ||
                         command->include_unfit || command->checked_only || !command->license.empty())) {
      throw CLI::ValidationError("--database",
                                 "cannot be combined with --format, --all-frames, --background, "
                                 "--include-unfit-frames, --checked-only or --license");
    }
    if (command->centered && command->format != "mesh")
      throw CLI::ValidationError("--centred", "needs --format mesh");
    if (!is_catalogue && command->format.empty())
      throw CLI::ValidationError("--format", "is required to export a session");
    job = [command, is_catalogue] {
      const CoreApplication qt;
      return is_catalogue ? exportObjects(*command) : exportSession(*command);
    };
  });
}

}  // namespace scantrove
