#include <functional>
#include <iostream>
#include <memory>
#include <utility>

#include "app/command.h"
#include "app/core_application.h"
#include "app/kernel_cache_use.h"
#include "app/session_edits.h"
#include "app/session_list_command.h"
#include "app/session_readout.h"
#include "app/session_refine_command.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

using SessionAction = std::function<Result<void>(OpenSession&, const SessionArguments&)>;

CLI::App* addAction(CLI::App& parent, const char* name, const char* help,
                    const std::shared_ptr<SessionArguments>& arguments, CommandOutcome& outcome,
                    SessionAction action) {
  CLI::App* sub = parent.add_subcommand(name, help);
  sub->add_option("DIR", arguments->folder, "the session: a folder that a scan was written to")->required();
  sub->add_flag("--json", arguments->json, "as JSON");
  sub->add_option("--device", arguments->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([arguments, &outcome, action = std::move(action)] {
    const KernelCacheUse kernels;
    const CoreApplication qt;
    auto session = OpenSession::open(arguments->folder, arguments->device);
    if (!session) return outcome.failWith(session.error());
    for (const std::string& damage : (*session)->damages())
      std::cerr << "scantrove: " << inLine(damage) << '\n';
    if (arguments->without_catalogue) (*session)->omitCatalogue();
    const auto done = action(**session, *arguments);
    if (!done) return outcome.failWith(done.error());
    if (const auto undisturbed = (*session)->findDisturbance(); !undisturbed)
      outcome.failWith(undisturbed.error());
  });
  return sub;
}

SessionAction edit(OperationKind kind) {
  return [kind](OpenSession& session, const SessionArguments& arguments) {
    return editSession(session, arguments, kind);
  };
}

}  // namespace

void addSessionCommand(CLI::App& app, CommandOutcome& outcome) {
  auto arguments = std::make_shared<SessionArguments>();
  CLI::App* parent = app.add_subcommand("session", "Look at scans and edit their regions");
  parent->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, SessionAction action) {
    return addAction(*parent, name, help, arguments, outcome, std::move(action));
  };
  const auto takeRegions = [&](CLI::App* sub) {
    sub->add_option("R", arguments->regions, "numbers of regions")->required();
    return sub;
  };
  const auto takeRegion = [&](CLI::App* sub) {
    sub->add_option("--region", arguments->regions, "number of the region")
        ->required()
        ->expected(1)
        ->type_name("R");
    return sub;
  };
  const auto takeOff = [&](CLI::App* sub) { sub->add_flag("--off", arguments->undo, "it is no longer"); };
  const auto takeCatalogue = [&](CLI::App* sub) {
    sub->add_flag("--no-catalogue", arguments->without_catalogue,
                  "in the session only, not in its catalogue");
    return sub;
  };
  addSessionList(*parent, outcome);
  addSessionRefine(*parent, outcome);
  add("show", "What there is: frames, map, regions, operations", showSession);
  add("regions", "All regions", listRegions);
  CLI::App* at = add("at", "The region that a pixel of a frame shows", showAt);
  at->add_option("--frame", arguments->frame, "number of the frame in its recording")
      ->required()
      ->type_name("N");
  at->add_option("--pixel", arguments->pixel, "column and row in the depth image")
      ->required()
      ->type_name("x,y");
  CLI::App* name = takeCatalogue(takeRegion(
      add("name", "Give a region a name, and so an object of the catalogue", edit(OperationKind::name))));
  name->add_option("--name", arguments->name, "empty takes it away")->required()->type_name("N");
  name->add_option("--class,--category", arguments->category, "its class, such as cup; kept when left out")
      ->type_name("C");
  takeRegions(
      add("join", "The regions are one thing; the first keeps its number", edit(OperationKind::join)));
  takeOff(
      takeRegions(add("background", "Wall, floor, table: not an object", edit(OperationKind::background))));
  takeOff(takeCatalogue(takeRegions(add("object", "An object, whole or not", edit(OperationKind::object)))));
  takeOff(takeRegions(add("reject", "Not an object", edit(OperationKind::reject))));
  takeRegions(add("finer", "Take a region apart", edit(OperationKind::finer)));
  takeRegions(add("coarser", "Join a region with its likeliest neighbour", edit(OperationKind::coarser)));
  CLI::App* cut_command = add("cut", "What lies here and what lies there are two things", cutRegion);
  for (const auto& [option, texts] :
       {std::pair("--here", &arguments->here), std::pair("--there", &arguments->there)}) {
    cut_command->add_option(option, *texts, "frame, column, row; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("N:x,y");
  }
  const auto takeSteps = [&](CLI::App* sub) {
    sub->add_option("--steps", arguments->steps, "so many")->check(CLI::PositiveNumber)->type_name("N");
  };
  takeSteps(takeCatalogue(add("undo", "Take the newest operation back", undoEdits)));
  takeSteps(takeCatalogue(add("redo", "Do it again", redoEdits)));
  add("history", "All operations", listOperations);
}

}  // namespace scantrove
