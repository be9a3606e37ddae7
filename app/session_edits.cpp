#include "app/session_edits.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "app/command.h"
#include "app/json_output.h"
#include "core/base/text.h"
#include "core/session/session_catalogue.h"

namespace scantrove {
namespace {

Operation operationOn(OperationKind kind, const SessionArguments& arguments) {
  Operation operation;
  operation.kind = kind;
  operation.name = arguments.name;
  operation.category = arguments.category.value_or("");
  operation.on = !arguments.undo;
  for (const std::uint32_t region : arguments.regions) operation.regions.push_back(RegionId{region});
  return operation;
}

/// Error: fewer than `steps` operations are in that state.
Result<void> checkSteps(const OpenSession& session, OperationLog::State state, int steps, const char* verb) {
  const auto available = std::ranges::count(session.history().entries(), state, &OperationLog::Entry::state);
  if (available == 0 || available >= steps) return {};  // with none, the operation reports the error
  return fail(
      "Only " + std::to_string(available) + " of " + std::to_string(steps) + " operations can be " + verb +
          "; nothing was changed.",
      "Give --steps " + std::to_string(available) + " or fewer; 'scantrove session history' lists them.");
}

}  // namespace

Result<void> reportEdit(const Result<RegionEditor::Outcome>& outcome, const SessionArguments& arguments) {
  if (!outcome) return fail(outcome.error());
  Json regions = Json::array();
  for (const RegionId region : outcome->regions) regions.push_back(region.value);
  if (arguments.json) {
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

void updateCatalogue(OpenSession& session, const SessionArguments& arguments) {
  if (arguments.without_catalogue || catalogueFileOf(session).empty()) return;
  if (const Result<void> applied = applyToCatalogue(session); !applied)
    std::cerr << "scantrove: The session was changed, but not its catalogue: "
              << forTerminal(applied.error().message()) << '\n';
}

Result<void> performEdit(OpenSession& session, const SessionArguments& arguments,
                         const Operation& operation) {
  const auto outcome = session.edit(operation);
  if (outcome) updateCatalogue(session, arguments);
  return reportEdit(outcome, arguments);
}

Result<void> editSession(OpenSession& session, const SessionArguments& arguments, OperationKind kind) {
  Operation operation = operationOn(kind, arguments);
  // A new name keeps the class unless one is given.
  if (isNaming(kind) && !arguments.category && !trimmed(arguments.name).empty() &&
      !operation.regions.empty()) {
    const RegionId region = operation.regions.front();
    const RegionLabel label = session.labelOf(region);
    operation.category = label.class_id ? label.category : session.noteOf(region).category;
  }
  for (const RegionId region : operation.regions) {
    if (isNaming(kind))
      session.setMetadata(sessionOnlyKeyOf(region), arguments.without_catalogue ? operation.name : "");
  }
  return performEdit(session, arguments, operation);
}

Result<void> markProposedBackground(OpenSession& session, const SessionArguments& arguments) {
  const auto regions = session.regions();
  if (!regions) return fail(regions.error());
  Operation operation;
  operation.kind = OperationKind::background;
  for (const RegionSummary& region : *regions) {
    if (region.is_proposed_background) operation.regions.push_back(region.region);
  }
  if (!operation.regions.empty()) return performEdit(session, arguments, operation);
  std::cerr << "scantrove: No region is proposed as background; nothing was changed.\n";
  if (arguments.json) printJson({{"regions", Json::array()}});
  return {};
}

Result<void> cutRegion(OpenSession& session, const SessionArguments& arguments) {
  Operation operation;
  operation.kind = OperationKind::cut;
  for (const auto& [texts, places] : {std::pair(&arguments.here, &operation.here_world),
                                      std::pair(&arguments.there, &operation.there_world)}) {
    for (const std::string& text : *texts) {
      const auto point = surfacePointAt(session, text, arguments.frame);
      if (!point) return fail(point.error());
      if (!point->region)
        return fail("There is no region at " + text + ".", "Give a pixel that shows a region.");
      if (operation.regions.empty()) operation.regions = {point->region};
      if (operation.regions.front() != point->region) {
        return fail("Region " + std::to_string(point->region.value) + " is at " + text + ", not region " +
                        std::to_string(operation.regions.front().value) + ".",
                    "Give points of one region.");
      }
      places->push_back(point->point_world);
    }
  }
  return reportEdit(session.edit(operation), arguments);
}

Result<void> undoEdits(OpenSession& session, const SessionArguments& arguments) {
  SCANTROVE_TRY(checkSteps(session, OperationLog::State::done, arguments.steps, "undone"));
  Result<RegionEditor::Outcome> outcome = RegionEditor::Outcome{};
  for (int i = 0; i < arguments.steps && outcome; ++i) {
    outcome = session.undo();
    if (outcome) updateCatalogue(session, arguments);
  }
  return reportEdit(outcome, arguments);
}

Result<void> redoEdits(OpenSession& session, const SessionArguments& arguments) {
  SCANTROVE_TRY(checkSteps(session, OperationLog::State::undone, arguments.steps, "redone"));
  Result<RegionEditor::Outcome> outcome = RegionEditor::Outcome{};
  for (int i = 0; i < arguments.steps && outcome; ++i) {
    outcome = session.redo();
    if (outcome) updateCatalogue(session, arguments);
  }
  return reportEdit(outcome, arguments);
}

}  // namespace scantrove
