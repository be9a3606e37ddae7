#include "app/session_refine_command.h"

#include <iomanip>
#include <iostream>
#include <memory>
#include <string>

#include "app/core_application.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/scan_runner.h"
#include "core/session/refinement_state.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

struct SessionRefineCommand {
  std::string folder;
  std::string device;
  bool json = false;
};

Result<bool> isRefinementPending(const std::string& folder) {
  const Result<std::unique_ptr<SessionStore>> store = SessionStore::open(folder);
  if (!store) return fail(store.error());
  const Result<SavedScan> scan = (*store)->load();
  if (!scan) return fail(scan.error());
  return canBeRefined(scan->metadata);
}

Result<void> refine(const SessionRefineCommand& command) {
  const KernelCacheUse kernels;
  const CoreApplication qt;
  const Result<bool> is_pending = isRefinementPending(command.folder);
  if (!is_pending) return fail(is_pending.error());
  ScanReport::Refinement refinement;
  if (*is_pending) {
    ScanRequest request;
    request.refine_session = true;
    request.output_folder = command.folder;
    request.device = command.device;
    const Result<ScanReport> report = runToEnd(request);
    if (!report) return fail(report.error());
    refinement = report->refinement;
  }
  if (command.json) {
    printJson({{"seconds", refinement.seconds},
               {"key_frames", refinement.key_frames},
               {"skipped", refinement.skipped}});
  } else if (!*is_pending) {
    std::cout << "The scan is refined already.\n";
  } else {
    std::cout << (refinement.skipped ? "partly refined" : "refined") << " with " << refinement.key_frames
              << " key frames in " << std::fixed << std::setprecision(1) << refinement.seconds << " s\n";
  }
  return {};
}

}  // namespace

void addSessionRefine(CLI::App& parent, CommandJob& job) {
  auto command = std::make_shared<SessionRefineCommand>();
  CLI::App* sub = parent.add_subcommand(
      "refine", "Refine the objects of a scan whose refinement was skipped or interrupted");
  sub->add_option("DIR", command->folder, "folder of the session")->required();
  sub->add_flag("--json", command->json, "as JSON");
  sub->add_option("--device", command->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([command, &job] { job = [command] { return refine(*command); }; });
}

}  // namespace scantrove
