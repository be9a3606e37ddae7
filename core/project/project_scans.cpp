#include "core/project/project_scans.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "core/session/open_session.h"
#include "core/session/session_list.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

/// A session and its scan, which live together.
struct OpenScan {
  explicit OpenScan(std::unique_ptr<OpenSession> opened) : session(std::move(opened)), scan(*session) {}
  std::unique_ptr<OpenSession> session;
  SessionScan scan;
};

Result<std::shared_ptr<LabeledScan>> openScan(const std::filesystem::path& folder, const std::string& device,
                                              const ScanWarning& warn) {
  auto session = OpenSession::open(folder, device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages()) warn(folder.filename().string() + ": " + damage);
  const auto open = std::make_shared<OpenScan>(std::move(*session));
  if (const auto missing = open->session->missingCatalogue()) warn(missing->message());
  return std::shared_ptr<LabeledScan>(open, &open->scan);
}

std::string namesOfScans(const std::vector<SessionSummary>& scans) {
  std::string text;
  for (const SessionSummary& scan : scans) text += (text.empty() ? "" : ", ") + scan.name;
  return text;
}

}  // namespace

Result<std::vector<ScanToExport>> scansToExport(const Project& project, const std::vector<std::string>& names,
                                                const std::string& device, const ScanWarning& warn) {
  std::vector<SessionSummary> scans = listSessions(project.scansFolder());
  std::ranges::sort(scans, {}, &SessionSummary::name);
  if (scans.empty()) {
    return fail("The project " + project.name + " has no scans: there is nothing to export.",
                "Scan something into it first, with 'scantrove project scan'.");
  }
  for (const std::string& name : names) {
    if (std::ranges::find(scans, name, &SessionSummary::name) != scans.end()) continue;
    return fail("The project " + project.name + " has no scan called '" + name + "'.",
                "Scans: " + namesOfScans(scans) + ".");
  }
  std::vector<ScanToExport> chosen;
  for (const SessionSummary& scan : scans) {
    const bool is_named = std::ranges::find(names, scan.name) != names.end();
    if (!names.empty() && !is_named) continue;
    if (!scan.damage.empty()) {
      const std::string what = "The scan " + scan.name + " cannot be read: " + scan.damage;
      if (is_named) return fail(what, "Choose other scans.");
      warn(what);
      continue;
    }
    chosen.push_back(
        {scan.name, [folder = scan.folder, device, warn] { return openScan(folder, device, warn); }});
  }
  if (chosen.empty())
    return fail("No scan of the project " + project.name + " can be read. " + scans.front().damage);
  return chosen;
}

}  // namespace scantrove
