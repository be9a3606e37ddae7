#include "app/project_scan.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "app/frame_use.h"
#include "app/scan_runner.h"
#include "core/exchange/atomic_file.h"
#include "core/project/recording_claim.h"
#include "core/session/recording_part.h"
#include "core/session/session_list.h"
#include "core/session/session_setup.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// "2026-11-22 15.40.02", local time.
std::string secondOfDay() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm local{};
  ::localtime_r(&now, &local);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H.%M.%S", &local)};
}

/// The project's scan of that part of the source: the one that read it to the end, else the newest that could
/// be continued. Null: none.
const SessionSummary* scanOf(const std::vector<SessionSummary>& scans, const std::string& source,
                             const std::string& part) {
  const SessionSummary* found = nullptr;
  for (const SessionSummary& scan : scans) {
    if (!scan.damage.empty() || scan.source != source || (!scan.part.empty() && scan.part != part)) continue;
    if (found == nullptr || (scan.read_to_end && !found->read_to_end)) found = &scan;
  }
  return found;
}

bool wasReadToEnd(const fs::path& folder) {
  const SessionMetadata metadata = readSessionMetadata(folder);
  const auto found = metadata.find(kReadToEndKey);
  return found != metadata.end() && !found->second.empty();
}

/// `earlier`: a stopped scan to continue, or null. Fills `outcome` but for a failure.
Result<void> scanInto(const Project& project, ScanRequest request, const SessionSummary* earlier,
                      RecordingOutcome& outcome) {
  request.resume = request.rest_only = earlier != nullptr;
  fs::path folder;
  if (earlier != nullptr) {
    folder = earlier->folder;
  } else {
    const std::string part = partInWords(request.source_options);
    std::string title = fs::path(request.source).filename().string();
    if (part != kWholeRecording) title += ", " + part;
    SCANTROVE_TRY(moveInto(folder, createScanFolder(project, secondOfDay(), title)));
  }
  request.output_folder = folder;
  request.database = project.catalogue.string();
  SCANTROVE_TRY(prepareOutputFolder(folder));
  const SourceOptions options = request.source_options;
  const auto report = runToEnd(std::move(request));
  if (!report) {
    std::error_code ignored;
    fs::remove(folder, ignored);  // only if the scan left it empty
    return fail(report.error());
  }
  outcome.scan = folder.filename().string();
  const bool had_no_rest =
      earlier != nullptr && report->frames.read == 0 && report->frames.skipped == 0 && wasReadToEnd(folder);
  if (!had_no_rest) SCANTROVE_TRY(checkFramesWereUsed(*report, options, earlier != nullptr));
  outcome.kind = wasReadToEnd(folder) ? RecordingOutcome::Kind::done : RecordingOutcome::Kind::stopped;
  outcome.is_continued = earlier != nullptr;
  outcome.read = report->frames.read;
  outcome.tracked = report->frames.tracked;
  outcome.regions = report->regions;
  outcome.objects = static_cast<int>(report->objects.size());
  return {};
}

Result<void> scanClaimed(const Project& project, const ScanRequest& request, RecordingOutcome& outcome) {
  SCANTROVE_TRY(prepareOutputFolder(project.scansFolder()));
  SCANTROVE_TRY(prepareOutputFolder(project.claimsFolder()));
  const std::string part = partInWords(request.source_options);
  const std::string claimed = part == kWholeRecording ? request.source : request.source + ", " + part;
  RecordingClaim::Attempt attempt;
  SCANTROVE_TRY(moveInto(attempt, RecordingClaim::take(project.claimsFolder(), claimed)));
  if (attempt.claim == nullptr) {
    outcome.kind = RecordingOutcome::Kind::skipped;
    outcome.reason = "another program scans it now (" + attempt.owner.describe() + ")";
    return {};
  }
  // Listed under the claim: another program may just have finished it.
  const std::vector<SessionSummary> scans = listSessions(project.scansFolder());
  const SessionSummary* earlier = scanOf(scans, request.source, part);
  if (earlier != nullptr && earlier->read_to_end) {
    outcome.kind = RecordingOutcome::Kind::skipped;
    outcome.scan = earlier->name;
    outcome.reason = "scanned before, as " + earlier->name;
    return {};
  }
  return scanInto(project, request, earlier, outcome);
}

}  // namespace

RecordingOutcome scanIntoProject(const Project& project, const ScanRequest& request) {
  RecordingOutcome outcome;
  outcome.source = request.source;
  if (const Result<void> done = scanClaimed(project, request, outcome); !done) {
    outcome.kind = RecordingOutcome::Kind::failed;
    outcome.reason = done.error().message();
  }
  return outcome;
}

}  // namespace scantrove
