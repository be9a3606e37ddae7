#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "app/argument_check.h"
#include "app/command.h"
#include "app/window_command.h"
#include "app/window_main.h"
#include "core/base/heap.h"
#include "core/base/log.h"
#include "core/base/text.h"
#include "core/compute/device_threads.h"

namespace scantrove {
namespace {

/// Options before a command belong to the window and would be ignored.
void refuseStrayOptions(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0)
      throw CLI::ExtrasError(app.get_name(), {option->get_name() + " must follow the command"});
  }
}

/// A failed write of the output, for example on a full disk, is a failure of the command.
int flushOutput(int exit_code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return exit_code;
  const std::string reason = errno != 0 ? ": " + std::generic_category().message(errno) : "";
  std::cerr << "scantrove: Cannot write to the standard output" << reason << ".\n";
  return exit_code == kDone ? kJobFailed : exit_code;
}

int run(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding `ulimit -f` is then a write error, as a full disk is
  useSingleArena();
  initializeLog();
  pinDeviceThreads();
  CommandOutcome outcome;
  WindowCommand window;
  WindowOptions window_options;
  CLI::App app{
      "Scan a scene with an RGB-D camera and collect its objects in a catalogue.\n"
      "Without a command: opens the window, and SOURCE in it.",
      "scantrove"};
  app.set_version_flag("--version", std::string("scantrove ") + SCANTROVE_VERSION);
  window.addTo(app);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "scantrove: " + forTerminal(error.what(), 400) + "\nRun with --help for more information.\n";
  });
  app.require_subcommand(0, 1);
  addScanCommand(app, outcome);
  addSessionCommand(app, outcome);
  addExportCommand(app, outcome);
  addRecordCommand(app, outcome);
  addEvaluateCommand(app, outcome);
  addObjectsCommand(app, outcome);
  addBenchCommand(app, outcome);
  addDevicesCommand(app, outcome);
  addParamsCommand(app, outcome);
  for (CLI::App* command : app.get_subcommands({})) {
    command->preparse_callback([&app](std::size_t) { refuseStrayOptions(app); });
  }
  refuseUnusableArguments(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) window_options = window.toOptions();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  if (!app.get_subcommands().empty()) return outcome.exit_code;
  int own_arguments = 1;  // hides our options from Qt
  return runWindow(own_arguments, argv, window_options);
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  try {
    return scantrove::flushOutput(scantrove::run(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "scantrove: " << scantrove::forTerminal(error.what()) << '\n';
    return scantrove::kJobFailed;
  }
}
