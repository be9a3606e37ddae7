#include <algorithm>
#include <charconv>
#include <iomanip>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/command.h"
#include "app/core_application.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/session_list_command.h"
#include "app/session_refine_command.h"
#include "core/base/text.h"
#include "core/scan/open_session.h"
#include "core/scan/session_catalogue.h"
#include "core/session/operation_json.h"

namespace scantrove {
namespace {

struct SessionCommand {
  std::string folder;
  std::string device;
  bool json = false;
  std::vector<std::uint32_t> regions;
  std::string name;
  std::optional<std::string> category;
  bool undo = false;
  bool without_catalogue = false;
  int steps = 1;
  int frame = 0;
  std::string pixel;
  std::vector<std::string> here, there;
};

/// A place of the session in its recording's world.
Json toJson(const Eigen::Vector3f& place, const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return {place.x(), place.y(), place.z()};
  return {place.x() + origin.x(), place.y() + origin.y(), place.z() + origin.z()};
}

Json toJson(const RegionSummary& region, const Eigen::Vector3d& origin) {
  Json json{{"id", region.region.value},
            {"voxels", region.voxels},
            {"centroid_m", toJson(region.centroid_world, origin)},
            {"box_m", {toJson(region.box_world.min(), origin), toJson(region.box_world.max(), origin)}},
            {"name", region.label.name},
            {"category", region.label.category},
            {"object", nullptr},
            {"is_object", region.label.is_object},
            {"confirmed", region.label.confirmed},
            {"background", region.label.background},
            {"rejected", region.label.rejected},
            {"seen_share", region.seen_from.share()}};
  if (region.label.object) json["object"] = region.label.object.value;
  return json;
}

/// "N:x,y" or "x,y".
struct PixelOfFrame {
  int frame = 0, x = 0, y = 0;
};

std::optional<PixelOfFrame> parsePixel(const std::string& text, int frame) {
  PixelOfFrame pixel{.frame = frame};
  std::string rest = text;
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    const auto number = parseNumbers(text.substr(0, colon));
    if (!number || number->size() != 1) return std::nullopt;
    pixel.frame = static_cast<int>(number->front());
    rest = text.substr(colon + 1);
  }
  const auto numbers = parseNumbers(rest);
  if (!numbers || numbers->size() != 2) return std::nullopt;
  pixel.x = static_cast<int>((*numbers)[0]);
  pixel.y = static_cast<int>((*numbers)[1]);
  return pixel;
}

Result<OpenSession::Place> placeOf(OpenSession& session, const std::string& text, int frame) {
  const auto pixel = parsePixel(text, frame);
  if (!pixel)
    return fail("'" + text + "' is no pixel.", "Write N:x,y: frame, column, row, for example 120:320,200.");
  return session.at(pixel->frame, pixel->x, pixel->y);
}

Result<void> show(OpenSession& session, const SessionCommand& command) {
  const auto regions = session.regions();
  if (!regions) return fail(regions.error());
  std::size_t usable = 0, named = 0, objects = 0, done = 0;
  for (const SavedFrame& frame : session.frames()) usable += frame.isUsable() ? 1U : 0U;
  for (const RegionSummary& region : *regions) {
    named += region.label.is_named ? 1U : 0U;
    objects += region.label.object ? 1U : 0U;
  }
  Json recordings = Json::array();
  for (const SavedRecording& one : session.recordings())
    recordings.push_back({{"source", one.source},
                          {"first_frame", one.first_frame},
                          {"index_shift", one.index_shift},
                          {"time_shift_s", one.time_shift_s}});
  for (const auto& entry : session.history().entries())
    done += entry.state == OperationLog::State::done ? 1U : 0U;
  const std::optional<bool> are_current = session.areResultsCurrent();
  if (command.json) {
    printJson({{"source", session.setup().source},
               {"recordings", recordings},
               {"frames", session.frames().size()},
               {"tracked", usable},
               {"key_frames", session.keyFrames().size()},
               {"bricks", session.brickCount()},
               {"regions", regions->size()},
               {"named", named},
               {"objects", objects},
               {"operations", done},
               {"ended", session.hasEnded()},
               {"refined", !session.canBeRefined()},
               {"results_current", are_current ? Json(*are_current) : Json(nullptr)},
               {"damages", session.damages()}});
    return {};
  }
  std::cout << "source      " << inLine(session.setup().source)
            << (session.hasEnded() ? "" : "  (recovered: the scan broke off)");
  for (const SavedRecording& one : session.recordings()) {
    if (one.first_frame > 0) std::cout << ", then " << inLine(one.source);
  }
  std::cout << "\nframes      " << session.frames().size() << ", " << usable << " tracked, "
            << session.keyFrames().size() << " kept as key frames\nmap         " << session.brickCount()
            << " bricks\nregions     " << regions->size() << ", " << named << " named, " << objects
            << " objects\noperations  " << done << "\nrefined     "
            << (session.canBeRefined() ? "no: 'scantrove session refine' does it" : "yes") << '\n';
  if (!are_current.value_or(true))
    std::cout << "files       cloud, labels.json and label images are from before the last edits; "
                 "'scantrove export' writes them anew\n";
  return {};
}

Result<void> listRegions(OpenSession& session, const SessionCommand& command) {
  const auto regions = session.regions();
  if (!regions) return fail(regions.error());
  if (session.missingCatalogue())
    std::cerr << "scantrove: " << inLine(session.missingCatalogue()->message()) << '\n';
  if (command.json) {
    Json json = Json::array();
    for (const RegionSummary& region : *regions) json.push_back(toJson(region, session.setup().origin_m));
    printJson(json);
    return {};
  }
  for (const RegionSummary& region : *regions) {
    const Eigen::Vector3f size_cm = 100 * region.box_world.sizes();
    std::cout << std::right << std::setw(6) << region.region.value << std::setw(9) << region.voxels
              << " voxels " << std::fixed << std::setprecision(0) << std::setw(5) << size_cm.x() << " x "
              << size_cm.y() << " x " << size_cm.z() << " cm  " << inLine(region.label.name)
              << (region.label.background ? "  background" : "")
              << (region.label.rejected ? "  rejected" : "") << '\n';
  }
  return {};
}

Result<void> showAt(OpenSession& session, const SessionCommand& command) {
  const auto place = placeOf(session, command.pixel, command.frame);
  if (!place) return fail(place.error());
  const std::string name = session.labelOf(place->region).name;
  if (command.json) {
    printJson({{"region", place->region.value},
               {"name", name},
               {"point_m", toJson(place->point_world, session.setup().origin_m)}});
  } else {
    std::cout << place->region.value << (name.empty() ? "" : "  ") << inLine(name) << '\n';
  }
  return {};
}

/// Says what an operation was about, by its regions as they are now.
Result<void> report(const Result<RegionEditor::Outcome>& outcome, const SessionCommand& command) {
  if (!outcome) return fail(outcome.error());
  Json regions = Json::array();
  for (const RegionId region : outcome->regions) regions.push_back(region.value);
  if (command.json) {
    printJson({{"regions", regions}});
    return {};
  }
  const char* separator = "";
  for (const RegionId region : outcome->regions) {
    std::cout << separator << region.value;
    separator = " ";
  }
  std::cout << '\n';
  return {};
}

Operation operationOn(OperationKind kind, const SessionCommand& command) {
  Operation operation;
  operation.kind = kind;
  operation.name = command.name;
  operation.category = command.category.value_or("");
  operation.on = !command.undo;
  for (const std::uint32_t region : command.regions) operation.regions.push_back(RegionId{region});
  return operation;
}

/// The session has it; that its catalogue has it not is worth a sentence, and no failure.
void tellCatalogue(OpenSession& session, const SessionCommand& command) {
  if (command.without_catalogue || catalogueFileOf(session).empty()) return;
  if (const Result<void> told = followInCatalogue(session); !told)
    std::cerr << "scantrove: The session has it, but not its catalogue: "
              << forTerminal(told.error().message()) << '\n';
}

template <OperationKind kKind>
Result<void> edit(OpenSession& session, const SessionCommand& command) {
  Operation operation = operationOn(kKind, command);
  // A new name leaves the category alone unless one is given.
  if (isNaming(kKind) && !command.category && !trimmed(command.name).empty() && !operation.regions.empty())
    operation.category = session.noteOf(operation.regions.front()).category;
  for (const RegionId region : operation.regions) {
    if (isNaming(kKind))
      session.setMetadata(sessionOnlyKeyOf(region), command.without_catalogue ? operation.name : "");
  }
  const auto outcome = session.edit(operation);
  if (outcome) tellCatalogue(session, command);
  return report(outcome, command);
}

Result<void> cut(OpenSession& session, const SessionCommand& command) {
  Operation operation;
  operation.kind = OperationKind::cut;
  for (const auto& [texts, places] :
       {std::pair(&command.here, &operation.here_world), std::pair(&command.there, &operation.there_world)}) {
    for (const std::string& text : *texts) {
      const auto place = placeOf(session, text, command.frame);
      if (!place) return fail(place.error());
      if (!place->region)
        return fail("At " + text + " there is no region.", "Point at something that has one.");
      if (operation.regions.empty()) operation.regions = {place->region};
      if (operation.regions.front() != place->region) {
        return fail("At " + text + " there is region " + std::to_string(place->region.value) +
                        ", not region " + std::to_string(operation.regions.front().value) +
                        ": they are two already.",
                    "Point at two places of one region.");
      }
      places->push_back(place->point_world);
    }
  }
  return report(session.edit(operation), command);
}

/// Error: fewer than `steps` operations are in that state. All steps are taken or none.
Result<void> checkSteps(const OpenSession& session, OperationLog::State state, int steps, const char* verb) {
  const auto available = std::ranges::count(session.history().entries(), state, &OperationLog::Entry::state);
  if (available == 0 || available >= steps) return {};  // for none, the operation itself has a message
  return fail(
      "Only " + std::to_string(available) + " of " + std::to_string(steps) + " operations can be " + verb +
          "; nothing was changed.",
      "Give --steps " + std::to_string(available) + " or fewer; 'scantrove session history' lists them.");
}

Result<void> undo(OpenSession& session, const SessionCommand& command) {
  SCANTROVE_TRY(checkSteps(session, OperationLog::State::done, command.steps, "undone"));
  Result<RegionEditor::Outcome> outcome = RegionEditor::Outcome{};
  for (int i = 0; i < command.steps && outcome; ++i) {
    outcome = session.undo();
    if (outcome) tellCatalogue(session, command);
  }
  return report(outcome, command);
}

Result<void> redo(OpenSession& session, const SessionCommand& command) {
  SCANTROVE_TRY(checkSteps(session, OperationLog::State::undone, command.steps, "redone"));
  Result<RegionEditor::Outcome> outcome = RegionEditor::Outcome{};
  for (int i = 0; i < command.steps && outcome; ++i) {
    outcome = session.redo();
    if (outcome) tellCatalogue(session, command);
  }
  return report(outcome, command);
}

const char* wordFor(OperationLog::State state) {
  switch (state) {
    case OperationLog::State::done:
      return "done";
    case OperationLog::State::undone:
      return "undone";
    case OperationLog::State::superseded:
      return "superseded";
  }
  return "";
}

Result<void> history(OpenSession& session, const SessionCommand& command) {
  Json json = Json::array();
  for (const OperationLog::Entry& entry : session.history().entries()) {
    Json one{{"number", entry.number}, {"state", wordFor(entry.state)}};
    one.update(Json::parse(operationToJson(entry.operation)));
    json.push_back(std::move(one));
  }
  if (command.json) {
    printJson(json);
    return {};
  }
  for (const OperationLog::Entry& entry : session.history().entries()) {
    std::cout << std::right << std::setw(4) << entry.number << "  " << std::left << std::setw(11)
              << wordFor(entry.state) << std::setw(11) << toString(entry.operation.kind);
    for (const RegionId region : entry.operation.regions) std::cout << ' ' << region.value;
    if (!entry.operation.name.empty()) std::cout << "  " << inLine(entry.operation.name);
    std::cout << '\n';
  }
  return {};
}

using SessionAction = Result<void> (*)(OpenSession&, const SessionCommand&);

CLI::App* addAction(CLI::App& parent, const char* name, const char* help,
                    const std::shared_ptr<SessionCommand>& command, CommandOutcome& outcome,
                    SessionAction action) {
  CLI::App* sub = parent.add_subcommand(name, help);
  sub->add_option("DIR", command->folder, "the session: a folder that a scan was written to")->required();
  sub->add_flag("--json", command->json, "as JSON");
  sub->add_option("--device", command->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([command, &outcome, action] {
    const KernelCacheUse kernels;
    const CoreApplication qt;
    auto session = OpenSession::open(command->folder, command->device);
    if (!session) return outcome.failWith(session.error());
    for (const std::string& damage : (*session)->damages())
      std::cerr << "scantrove: " << inLine(damage) << '\n';
    if (command->without_catalogue) (*session)->omitCatalogue();
    const auto done = action(**session, *command);
    if (!done) return outcome.failWith(done.error());
    if (const auto undisturbed = (*session)->findDisturbance(); !undisturbed)
      outcome.failWith(undisturbed.error());
  });
  return sub;
}

}  // namespace

void addSessionCommand(CLI::App& app, CommandOutcome& outcome) {
  auto command = std::make_shared<SessionCommand>();
  CLI::App* parent = app.add_subcommand("session", "Look at scans and edit their regions");
  parent->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, SessionAction action) {
    return addAction(*parent, name, help, command, outcome, action);
  };
  const auto takeRegions = [&](CLI::App* sub) {
    sub->add_option("R", command->regions, "numbers of regions")->required();
    return sub;
  };
  const auto takeRegion = [&](CLI::App* sub) {
    sub->add_option("--region", command->regions, "number of the region")
        ->required()
        ->expected(1)
        ->type_name("R");
    return sub;
  };
  const auto takeOff = [&](CLI::App* sub) { sub->add_flag("--off", command->undo, "it is no longer"); };
  const auto takeCatalogue = [&](CLI::App* sub) {
    sub->add_flag("--no-catalogue", command->without_catalogue, "in the session only, not in its catalogue");
    return sub;
  };
  addSessionList(*parent, outcome);
  addSessionRefine(*parent, outcome);
  add("show", "What there is: frames, map, regions, operations", show);
  add("regions", "All regions", listRegions);
  CLI::App* at = add("at", "The region that a pixel of a frame shows", showAt);
  at->add_option("--frame", command->frame, "number of the frame in its recording")
      ->required()
      ->type_name("N");
  at->add_option("--pixel", command->pixel, "column and row in the depth image")
      ->required()
      ->type_name("x,y");
  CLI::App* name = takeCatalogue(takeRegion(
      add("name", "Give a region a name, and so an object of the catalogue", edit<OperationKind::name>)));
  name->add_option("--name", command->name, "empty takes it away")->required()->type_name("N");
  name->add_option("--class,--category", command->category, "its class, such as cup; kept when left out")
      ->type_name("C");
  takeRegions(
      add("join", "The regions are one thing; the first keeps its number", edit<OperationKind::join>));
  takeOff(
      takeRegions(add("background", "Wall, floor, table: not an object", edit<OperationKind::background>)));
  takeOff(takeCatalogue(takeRegions(add("object", "An object, whole or not", edit<OperationKind::object>))));
  takeOff(takeRegions(add("reject", "Not an object", edit<OperationKind::reject>)));
  takeRegions(add("finer", "Take a region apart", edit<OperationKind::finer>));
  takeRegions(add("coarser", "Join a region with its likeliest neighbour", edit<OperationKind::coarser>));
  CLI::App* cut_command = add("cut", "What lies here and what lies there are two things", cut);
  for (const auto& [option, texts] :
       {std::pair("--here", &command->here), std::pair("--there", &command->there)}) {
    cut_command->add_option(option, *texts, "frame, column, row; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("N:x,y");
  }
  const auto takeSteps = [&](CLI::App* sub) {
    sub->add_option("--steps", command->steps, "so many")->check(CLI::PositiveNumber)->type_name("N");
  };
  takeSteps(takeCatalogue(add("undo", "Take the newest operation back", undo)));
  takeSteps(takeCatalogue(add("redo", "Do it again", redo)));
  add("history", "All operations", history);
}

}  // namespace scantrove
