#include <filesystem>

#include "app/command.h"
#include "core/base/log.h"

#if __has_include("app/window_main.h")
#include "app/window_main.h"
#endif

namespace scantrove {
namespace {

/// A word that is neither a command nor a source was a slip of the finger: it should not open a window.
std::string checkSource(const std::string& source) {
  const auto names = [&](const std::string& kind) {
    return source == kind || source.starts_with(kind + ":");
  };
  if (names("demo") || names("camera") || std::filesystem::exists(source)) return {};
  return "'" + source + "' is neither a command nor something to open (a folder, an .oni file, demo, camera)";
}

int openWindow([[maybe_unused]] int argc, [[maybe_unused]] char** argv,
               [[maybe_unused]] const std::string& source) {
#if __has_include("app/window_main.h")
  return runWindow(argc, argv, source);
#else
  std::cerr << "scantrove: this build has no window. Scan without it: scantrove scan SOURCE --out DIR\n";
  return kJobFailed;
#endif
}

int run(int argc, char** argv) {
  initialiseLog();
  CommandOutcome outcome;
  std::string source;
  CLI::App app{
      "Sweep an RGB-D camera over a scene, collect its objects in a database.\n"
      "Without a command: opens the window (and SOURCE in it).",
      "scantrove"};
  app.set_version_flag("--version", std::string("scantrove ") + SCANTROVE_VERSION);
  app.add_option("SOURCE", source, "a folder, an .oni file, 'demo', 'demo:room', 'camera' or 'camera:URI'")
      ->check(CLI::Validator(checkSource, ""));
  app.require_subcommand(0, 1);
  addScanCommand(app, outcome);
  addEvaluateCommand(app, outcome);
  addObjectsCommand(app, outcome);
  addBenchCommand(app, outcome);
  addDevicesCommand(app, outcome);
  addParamsCommand(app, outcome);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  if (app.get_subcommands().empty()) return openWindow(argc, argv, source);
  return outcome.exit_code;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  try {
    return scantrove::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "scantrove: " << error.what() << '\n';
    return scantrove::kJobFailed;
  }
}
