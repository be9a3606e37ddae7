#include <filesystem>
#include <iomanip>
#include <memory>

#include "app/command.h"
#include "app/core_application.h"
#include "app/frame_use.h"
#include "app/kernel_cache_use.h"
#include "app/object_options.h"
#include "app/scan_options.h"
#include "app/scan_runner.h"
#include "app/text_check.h"
#include "core/exchange/atomic_file.h"
#include "core/session/output_owner.h"

namespace scantrove {
namespace {

struct ScanArguments {
  ScanOptions options;
  std::string out;
  std::string database;
  std::string resume;
  bool no_session = false;
  bool label_maps = false;
  bool record = false;
  bool overwrite = false;
  bool skip_refinement = false;
  ObjectOptions object;
};

void printSummary(const ScanReport& report, const std::string& out) {
  const FrameCounts& frames = report.frames;
  std::size_t known = 0;
  for (const CollectedObject& object : report.objects) known += object.recognized_from.empty() ? 0U : 1U;
  std::cout << std::fixed << std::setprecision(1);
  std::cout << "frames   " << frames.read << " read, " << frames.tracked << " tracked";
  if (frames.by_device > 0) std::cout << " (" << frames.by_device << " by the device's poses alone)";
  std::cout << ", " << frames.lost << " lost";
  if (frames.skipped > 0) std::cout << ", " << frames.skipped << " unreadable";
  if (frames.dropped > 0) std::cout << ", " << frames.dropped << " dropped";
  std::cout << "\nspeed    " << report.fps << " fps (frame " << report.frame_median_ms << " ms median, "
            << report.frame_p95_ms << " ms p95) on " << inLine(report.device) << "\nmap      "
            << report.map_bricks << " bricks of voxels of "
            << 1000 * static_cast<double>(report.params.fusion.voxel_size_m) << " mm, "
            << report.map_megabytes << " MiB; peak memory " << report.peak_memory_mb << " MiB\nregions  "
            << report.regions << "\nobjects  " << report.objects.size() - known << " new, " << known
            << " recognised";
  const char* separator = ": ";
  for (const CollectedObject& object : report.objects) {
    std::cout << separator << inLine(object.name);
    separator = ", ";
  }
  const ScanReport::Refinement& refinement = report.refinement;
  if (refinement.skipped) {
    std::cout << "\nrefined  no; run 'scantrove session refine'";
  } else if (refinement.key_frames > 0) {
    std::cout << "\nrefined  with " << refinement.key_frames << " key frames in " << refinement.seconds
              << " s";
  }
  std::cout << "\nresults  " << inLine(out) << '\n';
}

Result<void> scan(const ScanArguments& command, ScanRequest request) {
  const CoreApplication qt;  // reading the session of the folder needs it
  const std::string& out = command.resume.empty() ? command.out : command.resume;
  request.resume = !command.resume.empty();
  request.overwrite = command.overwrite;
  request.record_all = command.record;
  request.session = !command.no_session;
  // Checked first, so that a scan does not fail at its end.
  if (!request.resume && !command.overwrite)
    SCANTROVE_TRY(checkHoldsOnlyOurs(out, {true, command.label_maps}));
  SCANTROVE_TRY(prepareOutputFolder(out));
  request.output_folder = out;
  request.database = command.database;
  if (command.database.empty() && !request.resume)
    request.database = (*request.output_folder / "catalogue.sqlite").string();
  request.label_maps = command.label_maps;
  const KernelCacheUse kernels;
  request.skip_refinement = command.skip_refinement;
  const auto report = runToEnd(request);
  if (!report) return fail(report.error());
  SCANTROVE_TRY(checkFramesWereUsed(*report, request.source_options, request.resume));
  printSummary(*report, out);
  return {};
}

}  // namespace

void addScanCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<ScanArguments>();
  CLI::App* sub = app.add_subcommand("scan", "Scan a recording or a camera without a window");
  sub->add_option("SOURCE", command->options.source, kSourceHelp)->required()->check(notEmpty("SOURCE"));
  sub->add_option("--out", command->out, "folder for the results; created if missing")->type_name("DIR");
  sub->add_option("--resume", command->resume, "instead of --out: continue the scan in this folder")
      ->type_name("DIR");
  sub->add_flag("--record", command->record, "store the images of all frames, not only of key frames");
  sub->add_flag("--no-session", command->no_session, "write results only; the scan cannot be opened again")
      ->excludes("--resume")
      ->excludes("--record");
  sub->add_option(
         "--database", command->database,
         "catalogue to search and extend (default: DIR/catalogue.sqlite, or that of the continued scan)")
      ->type_name("FILE|URL");
  sub->add_flag("--label-maps", command->label_maps, "also write segments and regions of each frame as PNGs");
  sub->add_flag("--skip-refinement", command->skip_refinement,
                "skip the refinement; 'scantrove session refine' does it later");
  sub->add_flag("--overwrite", command->overwrite,
                "replace result files in DIR that no scan wrote; other files stay")
      ->excludes("--resume");
  command->options.addTo(*sub);
  command->object.addTo(*sub);
  sub->callback([command, &job] {
    if (command->out.empty() == command->resume.empty()) {
      throw CLI::ValidationError("--out",
                                 "is the folder of a new scan, --resume of an earlier one. Give one of them");
    }
    ScanRequest request = command->options.toRequest();
    request.object = command->object.toChoice();
    job = [command, request] { return scan(*command, request); };
  });
}

}  // namespace scantrove
