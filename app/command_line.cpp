#include "app/command_line.h"

#include <sstream>

#include "app/argument_check.h"
#include "app/command.h"
#include "app/window_command.h"

namespace scantrove {
namespace {

/// Options before a command belong to the window and would be ignored.
void refuseStrayOptions(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0)
      throw CLI::ExtrasError(app.get_name(), {option->get_name() + " must follow the command"});
  }
}

void addCommands(CLI::App& app, CommandJob& job) {
  addScanCommand(app, job);
  addSessionCommand(app, job);
  addExportCommand(app, job);
  addRenderCommand(app, job);
  addRecordCommand(app, job);
  addEvaluateCommand(app, job);
  addProjectCommand(app, job);
  addObjectsCommand(app, job);
  addBenchCommand(app, job);
  addDevicesCommand(app, job);
  addParamsCommand(app, job);
  addReferenceCommand(app, job);
  for (CLI::App* command : app.get_subcommands({})) {
    command->preparse_callback([&app](std::size_t) { refuseStrayOptions(app); });
  }
}

}  // namespace

CommandLine parseCommandLine(int argc, const char* const* argv) {
  CommandLine line;
  WindowCommand window;
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
  addCommands(app, line.job);
  refuseUnusableArguments(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) line.window = window.toOptions();
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    line.exit_code = app.exit(error, out, err) == 0 ? kDone : kWrongUsage;
    line.out = out.str();
    line.err = err.str();
  }
  return line;
}

}  // namespace scantrove
