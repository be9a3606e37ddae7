#include "app/session_list_command.h"

#include <filesystem>
#include <iomanip>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "app/core_application.h"

namespace scantrove {
namespace {

struct SessionListCommand {
  std::string folder;
  bool json = false;
};

Json toJson(const SessionSummary& session) {
  return {{"path", session.folder.string()},
          {"name", session.name},
          {"started", session.started},
          {"source", session.source},
          {"part", session.part},
          {"frames", session.frames},
          {"tracked", session.tracked},
          {"key_frames", session.key_frames},
          {"reviewed", session.reviews.reviewed()},
          {"regions", session.regions},
          {"named", session.names},
          {"objects", session.objects},
          {"megabytes", session.megabytes},
          {"ended", session.ended},
          {"read_to_end", session.read_to_end},
          {"in_use", session.in_use},
          {"recovered", session.isRecovered()},
          {"picture", session.picture.string()},
          {"damage", session.damage}};
}

void printSession(const SessionSummary& session) {
  if (!session.damage.empty()) {
    std::cout << inLine(session.name) << "  damaged: " << inLine(session.damage) << '\n';
    return;
  }
  std::cout << inLine(session.name) << "  " << inLine(session.started.substr(0, 16)) << "  "
            << inLine(session.source) << "  " << session.frames << " frames, " << session.regions
            << " regions, " << session.names.size() << " named, " << session.objects << " objects, "
            << std::fixed << std::setprecision(1) << session.megabytes << " MB"
            << (session.in_use ? "  in use" : (session.ended ? "" : "  recovered after an interrupted scan"))
            << '\n';
  const char* separator = "    ";
  for (const std::string& name : session.names) std::cout << std::exchange(separator, ", ") << inLine(name);
  if (!session.names.empty()) std::cout << '\n';
}

Result<void> listAll(const SessionListCommand& command) {
  const std::filesystem::path folder =
      command.folder.empty() ? defaultScansFolder() : std::filesystem::path(command.folder);
  std::error_code failure;
  if (!command.folder.empty() && !std::filesystem::is_directory(folder, failure)) {
    return fail("There is no folder " + folder.string() + ".", "Give the folder that holds sessions.");
  }
  const std::vector<SessionSummary> sessions = listSessions(folder);
  if (command.json) {
    printJson(toJson(sessions));
    return {};
  }
  printSessions(sessions);
  if (sessions.empty()) std::cerr << "There are no sessions in " << inLine(folder.string()) << ".\n";
  return {};
}

}  // namespace

Json toJson(const std::vector<SessionSummary>& sessions) {
  Json json = Json::array();
  for (const SessionSummary& session : sessions) json.push_back(toJson(session));
  return json;
}

void printSessions(const std::vector<SessionSummary>& sessions) {
  for (const SessionSummary& session : sessions) printSession(session);
}

void addSessionList(CLI::App& parent, CommandJob& job) {
  auto command = std::make_shared<SessionListCommand>();
  CLI::App* sub = parent.add_subcommand("list", "List the sessions in a folder, newest first");
  sub->add_option("DIR", command->folder, "folder with sessions (default: $XDG_DATA_HOME/scantrove/scans)");
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, &job] {
    job = [command] {
      const CoreApplication qt;
      return listAll(*command);
    };
  });
}

}  // namespace scantrove
