#include <QTemporaryDir>
#include <memory>

#include "app/bench_statistics.h"
#include "app/command.h"
#include "app/core_application.h"
#include "app/frame_use.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/scan_options.h"
#include "app/scan_runner.h"
#include "app/text_check.h"

namespace scantrove {
namespace {

struct BenchCommand {
  ScanOptions options;
  bool json = false;
  bool kernels = false;
};

Result<void> bench(ScanRequest request, bool json) {
  const KernelCacheUse kernels;
  const CoreApplication qt;
  // Each run starts with an empty catalogue and session, so all runs do the same work as a scan.
  const QTemporaryDir folder;
  if (!folder.isValid())
    return fail("Cannot make a temporary folder: " + folder.errorString().toStdString() + ".");
  request.database = folder.filePath("catalogue.sqlite").toStdString();
  request.output_folder = folder.filePath("session").toStdString();
  request.results = false;
  std::vector<BenchSample> samples;
  const auto report = runToEnd(request, [&](const ScanSnapshot& snapshot) {
    const bool is_new = samples.empty() || snapshot.frames.done() > samples.back().frames_done;
    if (is_new && snapshot.pose.usable()) samples.push_back(sampleOf(snapshot));
  });
  if (!report) return fail(report.error());
  SCANTROVE_TRY(checkFramesWereUsed(*report, request.source_options));
  if (json) {
    printJson(benchJson(*report, samples));
  } else {
    std::cout << benchTable(*report, samples);
  }
  return {};
}

}  // namespace

void addBenchCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<BenchCommand>();
  command->options.source = "demo";
  CLI::App* sub =
      app.add_subcommand("bench", "Measure the time of each scan stage, and how it grows with the map");
  sub->add_option("SOURCE", command->options.source, "as 'scan' takes it (default demo)")
      ->check(notEmpty("SOURCE"));
  sub->add_flag("--json", command->json, "as JSON");
  sub->add_flag("--kernels", command->kernels,
                "also time each OpenCL kernel (runs them one at a time, which slows the scan)");
  command->options.addTo(*sub);
  sub->callback([command, &job] {
    ScanRequest request = command->options.toRequest();
    request.profile_kernels = command->kernels;
    job = [command, request] { return bench(request, command->json); };
  });
}

}  // namespace scantrove
