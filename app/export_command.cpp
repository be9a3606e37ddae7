#include <cmath>
#include <memory>
#include <stop_token>

#include "app/command.h"
#include "app/core_application.h"
#include "app/stop_signal.h"
#include "core/dataset/dataset_export.h"
#include "core/scan/session_scan.h"

namespace scantrove {
namespace {

struct ExportCommand {
  std::string folder, out, format, device;
  bool all_frames = false, background = false;
};

Result<void> exportSession(const ExportCommand& command) {
  const Result<DatasetFormat> format = parseDatasetFormat(command.format);
  if (!format) return fail(format.error());
  auto session = OpenSession::open(command.folder, command.device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages()) std::cerr << "scantrove: " << damage << '\n';
  SessionScan scan(**session);
  listenForStop();
  std::stop_source stop;
  int last_percent = -1;
  const auto tell = [&](const ExportProgress& progress) {
    if (stopRequested()) stop.request_stop();
    const int percent = progress.total > 0 ? 10 * (10 * progress.done / progress.total) : 0;
    if (percent != std::exchange(last_percent, percent))
      std::cerr << percent << " % " << progress.what << '\n';
  };
  const auto summary = exportDataset(scan, {*format, command.out, command.all_frames, command.background},
                                     tell, stop.get_token());
  if (!summary) return fail(summary.error());
  for (const std::string& skipped : summary->skipped) std::cerr << "scantrove: " << skipped << '\n';
  std::cout << command.format << "     " << summary->images << " images, " << summary->regions << " regions, "
            << summary->annotations << " annotations";
  if (summary->points > 0) std::cout << ", " << summary->points << " points";
  if (summary->faces > 0) std::cout << ", " << summary->faces << " faces";
  std::cout << ", " << std::lround(static_cast<double>(summary->bytes) / 1e6) << " MB\nresults  "
            << summary->folder.string() << '\n';
  return {};
}

}  // namespace

void addExportCommand(CLI::App& app, CommandOutcome& outcome) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand("export", "Make a data set of a scan");
  sub->add_option("DIR", command->folder, "the session: a folder that a scan was written to")->required();
  sub->add_option("--format", command->format, "what to make")
      ->required()
      ->check(CLI::IsMember(datasetFormatNames()))
      ->type_name("coco|bop|yolo|masks|ply|pcd|mesh|tum|scannet");
  sub->add_option("--out", command->out, "folder for the data set, which must be empty or missing")
      ->required()
      ->type_name("DIR2");
  sub->add_flag("--all-frames", command->all_frames, "every frame that was kept, not key frames only");
  sub->add_flag("--background", command->background, "also what is background or was rejected");
  sub->add_option("--device", command->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([command, &outcome] {
    const CoreApplication qt;
    if (const auto done = exportSession(*command); !done) outcome.failWith(done.error());
  });
}

}  // namespace scantrove
