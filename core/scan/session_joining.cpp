#include "core/scan/session_joining.h"

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "core/catalogue/object_database.h"
#include "core/scan/first_error.h"
#include "core/scan/open_session.h"
#include "core/scan/session_catalogue.h"

namespace scantrove {
namespace {

using JoinJson = nlohmann::ordered_json;

constexpr std::array<std::pair<JoinedObjects::State, const char*>, 3> kStates{
    {{JoinedObjects::State::to_merge, "to merge"},
     {JoinedObjects::State::done, "done"},
     {JoinedObjects::State::to_part, "to part"}}};

const char* wordFor(JoinedObjects::State state) {
  return std::ranges::find(kStates, state, &std::pair<JoinedObjects::State, const char*>::first)->second;
}

std::optional<JoinedObjects::State> stateFrom(const std::string& word) {
  for (const auto& [state, known] : kStates) {
    if (word == known) return state;
  }
  return std::nullopt;
}

ObjectId objectFrom(const JoinJson& json) { return ObjectId{json.get<std::uint32_t>()}; }

Result<std::unique_ptr<ObjectDatabase>> openCatalogue(OpenSession& session) {
  const std::filesystem::path file = catalogueFileOf(session);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return fail("The catalogue " + file.string() + " of this session is not there.",
                "Put it back; the next edit tries again.");
  auto database = ObjectDatabase::open(file.string());
  if (!database) return database;
  const Result<bool> is_other = session.useCatalogue(**database);
  if (!is_other) return fail(is_other.error());
  return database;
}

/// The merge that made one of the two; none: they are two, or one was deleted.
Result<std::optional<ObjectMerge>> mergeTwo(ObjectDatabase& database, ObjectId a, ObjectId b) {
  std::array<ObjectId, 2> merge_roots;
  SCANTROVE_TRY(moveInto(merge_roots[0], database.resolve(a)));
  SCANTROVE_TRY(moveInto(merge_roots[1], database.resolve(b)));
  if (!merge_roots[0] || !merge_roots[1]) return std::nullopt;
  if (merge_roots[0] == merge_roots[1])  // an interruption left it so
    return ObjectMerge{merge_roots[0], {merge_roots[0] == a ? b : a}, false};
  const auto first = database.object(merge_roots[0]), second = database.object(merge_roots[1]);
  if (!first) return fail(first.error());
  if (!second) return fail(second.error());
  if (isSettled(*first) && isSettled(*second)) {
    return fail("The objects " + first->name + " and " + second->name +
                    " stay two in the catalogue, for a person said what each is.",
                "'scantrove objects merge' makes one of them.");
  }
  const Result<ObjectMerge> merge = database.merge(merge_roots);
  if (!merge) return fail(merge.error());
  return *merge;
}

/// Of one operation. Error: the first thing that could not be done; it is not tried again.
Result<void> carryOut(ObjectDatabase& database, JoinedObjects& joined) {
  FirstError first;
  if (joined.state == JoinedObjects::State::to_merge) {
    for (const auto& [a, b] : std::exchange(joined.pairs, {})) {
      auto merge = mergeTwo(database, a, b);
      if (!merge) {
        first.note(fail(merge.error()));
      } else if (*merge) {
        joined.merges.push_back(std::move(**merge));
      }
    }
    joined.state = JoinedObjects::State::done;
  } else {
    for (auto merge = joined.merges.rbegin(); merge != joined.merges.rend(); ++merge) {
      const Result<ObjectId> root = database.resolve(merge->from.front());
      // Others may have parted them, or deleted them, since.
      if (root && *root == merge->into) first.note(database.unmerge(*merge));
    }
    joined = {};
  }
  return first.result();
}

}  // namespace

std::string joinKeyOf(int operation) { return "join " + std::to_string(operation); }

std::string joinedToText(const JoinedObjects& joined) {
  if (joined.before.empty()) return {};
  JoinJson json{{"state", wordFor(joined.state)},
                {"before", JoinJson::object()},
                {"pairs", JoinJson::array()},
                {"merges", JoinJson::array()}};
  for (const auto& [region, object] : joined.before)
    json["before"][std::to_string(region.value)] = object.value;
  for (const auto& [a, b] : joined.pairs) json["pairs"].push_back({a.value, b.value});
  for (const ObjectMerge& merge : joined.merges) {
    JoinJson from = JoinJson::array();
    for (const ObjectId object : merge.from) from.push_back(object.value);
    json["merges"].push_back(
        {{"into", merge.into.value}, {"from", from}, {"confirmed", merge.has_confirmed}});
  }
  return json.dump();
}

JoinedObjects joinedFrom(const std::string& text) {
  if (text.empty()) return {};
  try {
    const JoinJson json = JoinJson::parse(text);
    JoinedObjects joined;
    joined.state = stateFrom(json.at("state").get<std::string>()).value_or(JoinedObjects::State::done);
    for (const auto& [region, object] : json.at("before").items())
      joined.before[RegionId{static_cast<std::uint32_t>(std::stoul(region))}] = objectFrom(object);
    for (const JoinJson& pair : json.at("pairs"))
      joined.pairs.emplace_back(objectFrom(pair.at(0)), objectFrom(pair.at(1)));
    for (const JoinJson& one : json.at("merges")) {
      ObjectMerge merge{objectFrom(one.at("into")), {}, one.at("confirmed").get<bool>()};
      for (const JoinJson& from : one.at("from")) merge.from.push_back(objectFrom(from));
      if (!merge.from.empty()) joined.merges.push_back(std::move(merge));
    }
    return joined;
  } catch (const std::exception&) {
    return {};
  }
}

JoinedObjects joinObjects(const RegionEvents& events, std::map<RegionId, ObjectId>& objects) {
  JoinedObjects joined;
  for (const auto& [into, from] : events.joined) {
    ObjectId& kept = objects[into];
    const ObjectId gone = std::exchange(objects[from], {});
    joined.before.try_emplace(into, kept);
    joined.before.try_emplace(from, gone);
    if (!gone || gone == kept) continue;
    if (!kept) {
      kept = gone;
    } else {
      joined.pairs.emplace_back(kept, gone);
    }
  }
  const bool is_any =
      std::ranges::any_of(joined.before, [](const auto& entry) { return bool(entry.second); });
  if (!is_any) return {};
  if (!joined.pairs.empty()) joined.state = JoinedObjects::State::to_merge;
  return joined;
}

Result<void> mergeJoinedObjects(OpenSession& session) {
  FirstError first;
  for (const OperationLog::Entry& entry : session.history().entries()) {
    const std::string name = joinKeyOf(entry.number);
    if (joinedFrom(session.fact(name)).state == JoinedObjects::State::done) continue;
    const auto database = openCatalogue(session);
    if (!database) return fail(database.error());
    JoinedObjects joined = joinedFrom(session.fact(name));  // none, where the catalogue is another one
    if (joined.state == JoinedObjects::State::done) continue;
    first.note(carryOut(**database, joined));
    session.setMetadata(name, joinedToText(joined));
    SCANTROVE_TRY(session.saveMetadata());
  }
  return first.result();
}

}  // namespace scantrove
