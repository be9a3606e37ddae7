#include "app/session_suggest.h"

#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command.h"
#include "app/json_output.h"
#include "app/session_edits.h"
#include "core/session/mask_suggestions.h"

namespace scantrove {
namespace {

/// What became of a proposal.
struct AppliedProposal {
  std::vector<RegionId> regions;  ///< that the operation resulted in
  std::optional<Error> failure;
};

int agreeing(const EditProposal& proposal) {
  const bool is_join = proposal.operation.kind == OperationKind::join;
  return is_join ? proposal.votes.together : proposal.votes.apart;
}

int contradicting(const EditProposal& proposal) {
  const bool is_join = proposal.operation.kind == OperationKind::join;
  return is_join ? proposal.votes.apart : proposal.votes.together;
}

Json toJson(const std::vector<RegionId>& regions) {
  Json json = Json::array();
  for (const RegionId region : regions) json.push_back(region.value);
  return json;
}

Json toJson(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& origin) {
  Json json = Json::array();
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d world = point.cast<double>() + origin;
    json.push_back({world.x(), world.y(), world.z()});
  }
  return json;
}

Json toJson(const EditProposal& proposal, const Eigen::Vector3d& origin) {
  const Operation& operation = proposal.operation;
  Json json{{"kind", std::string(toString(operation.kind))},
            {"regions", toJson(operation.regions)},
            {"frames_for", agreeing(proposal)},
            {"frames_against", contradicting(proposal)}};
  if (operation.kind == OperationKind::cut) {
    json["here_m"] = toJson(operation.here_world, origin);
    json["there_m"] = toJson(operation.there_world, origin);
  }
  return json;
}

void printAsJson(const MaskSuggestions& suggestions, const std::vector<AppliedProposal>& applied,
                 const Eigen::Vector3d& origin) {
  Json proposals = Json::array();
  for (std::size_t i = 0; i < suggestions.proposals.size(); ++i) {
    Json one = toJson(suggestions.proposals[i], origin);
    one["result"] = i < applied.size() && !applied[i].failure ? toJson(applied[i].regions) : Json(nullptr);
    proposals.push_back(std::move(one));
  }
  printJson({{"key_frames", suggestions.key_frames}, {"masks", suggestions.masks}, {"proposals", proposals}});
}

void printAsText(const OpenSession& session, const MaskSuggestions& suggestions,
                 const std::vector<AppliedProposal>& applied) {
  for (std::size_t i = 0; i < suggestions.proposals.size(); ++i) {
    const EditProposal& proposal = suggestions.proposals[i];
    std::cout << std::left << std::setw(6) << toString(proposal.operation.kind) << std::right << std::setw(4)
              << agreeing(proposal) << " frames for, " << contradicting(proposal) << " against  ";
    for (const RegionId region : proposal.operation.regions) {
      const std::string name = session.labelOf(region).name;
      std::cout << ' ' << region.value << (name.empty() ? "" : " (" + inLine(name) + ")");
    }
    if (i < applied.size() && !applied[i].failure) {
      std::cout << "  ->";
      for (const RegionId region : applied[i].regions) std::cout << ' ' << region.value;
    }
    std::cout << '\n';
  }
}

std::string countText(std::size_t count, const char* what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

void printSuggestionCounts(const MaskSuggestions& suggestions, const SessionArguments& arguments) {
  std::cerr << countText(suggestions.proposals.size(), "proposal") << " from "
            << countText(suggestions.masks, "mask") << " of "
            << countText(suggestions.key_frames, "key frame");
  if (suggestions.proposals.empty() || arguments.apply) {
    std::cerr << ".\n";
  } else {
    std::cerr << "; --apply performs them.\n";
  }
}

/// Each is an operation of its own, so that one of them can be taken back.
std::vector<AppliedProposal> applyAll(OpenSession& session, const std::vector<EditProposal>& proposals,
                                      const SessionArguments& arguments) {
  std::vector<AppliedProposal> applied;
  for (const EditProposal& proposal : proposals) {
    const auto outcome = session.edit(proposal.operation);
    if (outcome) updateCatalogue(session, arguments);
    applied.push_back(outcome ? AppliedProposal{outcome->regions, std::nullopt}
                              : AppliedProposal{{}, outcome.error()});
  }
  return applied;
}

/// Error: operations failed.
Result<void> checkApplied(const std::vector<AppliedProposal>& applied) {
  std::size_t failures = 0;
  for (const AppliedProposal& one : applied) {
    if (!one.failure) continue;
    ++failures;
    std::cerr << "scantrove: " << inLine(one.failure->message()) << '\n';
  }
  if (failures == 0) return {};
  return fail(std::to_string(failures) + " of " + std::to_string(applied.size()) +
                  " proposals could not be performed.",
              "'scantrove session undo' takes back the others, one at a time.");
}

}  // namespace

Result<void> suggestFromMasks(OpenSession& session, const SessionArguments& arguments) {
  const Result<MaskFolder> masks = MaskFolder::open(arguments.masks);
  if (!masks) return fail(masks.error());
  const Result<MaskSuggestions> suggestions = suggestEdits(session, *masks, {arguments.min_frames});
  if (!suggestions) return fail(suggestions.error());
  std::vector<AppliedProposal> applied;
  if (arguments.apply) applied = applyAll(session, suggestions->proposals, arguments);
  if (arguments.json) {
    printAsJson(*suggestions, applied, session.setup().origin_m);
  } else {
    printAsText(session, *suggestions, applied);
    printSuggestionCounts(*suggestions, arguments);
  }
  return checkApplied(applied);
}

}  // namespace scantrove
