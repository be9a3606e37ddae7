#include "core/session/pending_edits.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <string_view>
#include <utility>

namespace scantrove {
namespace {

using Kind = CatalogueStep::Kind;
using PendingJson = nlohmann::ordered_json;

constexpr std::array<std::pair<Kind, std::string_view>, 5> kKinds{{{Kind::name, "name"},
                                                                   {Kind::redo_name, "name again"},
                                                                   {Kind::revert_name, "take name"},
                                                                   {Kind::add, "add"},
                                                                   {Kind::revert_object, "take object"}}};

CatalogueStep stepFrom(const PendingJson& json) {
  const auto word = json.at("do").get<std::string>();
  const auto kind = std::ranges::find(kKinds, word, &std::pair<Kind, std::string_view>::second);
  if (kind == kKinds.end()) throw PendingJson::other_error::create(501, "no such step", nullptr);
  return {kind->first, RegionId{json.at("region").get<std::uint32_t>()}, json.value("name", ""),
          json.value("class", "")};
}

}  // namespace

std::string newToken() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x", random());
    token += digits.data();
  }
  return token;
}

std::vector<CatalogueStep> catalogueStepsOf(const Operation& operation, EditDirection direction,
                                            const std::function<const RegionNote&(RegionId)>& note_of) {
  const bool is_undone = direction == EditDirection::undone;
  const bool is_adding = operation.kind == OperationKind::object && operation.on;
  std::vector<CatalogueStep> steps;
  if (!isNaming(operation.kind) && !is_adding) return steps;
  for (const RegionId region : operation.regions) {
    if (is_adding) {
      steps.push_back({is_undone ? Kind::revert_object : Kind::add, region});
      continue;
    }
    // Removing a name reverts the naming; undoing that names the region again, as its note now says.
    const bool is_removal = operation.name.empty();
    if (is_removal != is_undone) {
      steps.push_back({Kind::revert_name, region, operation.name});
      continue;
    }
    const std::string& given = is_removal ? note_of(region).name : operation.name;
    const std::string& category = is_removal ? note_of(region).category : operation.category;
    if (!given.empty())
      steps.push_back(
          {direction == EditDirection::redone ? Kind::redo_name : Kind::name, region, given, category});
  }
  if (is_undone) std::ranges::reverse(steps);
  return steps;
}

PendingEdit pendingEditOf(std::vector<CatalogueStep> steps) { return {newToken(), std::move(steps)}; }

std::string pendingEditsToJson(const std::vector<PendingEdit>& edits) {
  if (edits.empty()) return {};
  PendingJson json = PendingJson::array();
  for (const PendingEdit& edit : edits) {
    PendingJson steps = PendingJson::array();
    for (const CatalogueStep& step : edit.steps) {
      const auto word =
          std::ranges::find(kKinds, step.kind, &std::pair<Kind, std::string_view>::first)->second;
      steps.push_back({{"do", word}, {"region", step.region.value}, {"name", step.name}});
      if (!step.class_name.empty()) steps.back()["class"] = step.class_name;
    }
    json.push_back({{"token", edit.token}, {"steps", std::move(steps)}});
  }
  return json.dump(-1, ' ', false, PendingJson::error_handler_t::replace);
}

std::vector<PendingEdit> pendingEditsFromJson(const std::string& text) {
  std::vector<PendingEdit> edits;
  try {
    if (text.empty()) return edits;
    for (const PendingJson& json : PendingJson::parse(text)) {
      PendingEdit edit{json.at("token").get<std::string>(), {}};
      for (const PendingJson& step : json.at("steps")) edit.steps.push_back(stepFrom(step));
      edits.push_back(std::move(edit));
    }
  } catch (const PendingJson::exception&) {
    edits.clear();
  }
  return edits;
}

}  // namespace scantrove
