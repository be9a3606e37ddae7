#include "core/session/session_joining.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/catalogue/class_json.h"
#include "core/catalogue/object_database.h"
#include "core/session/open_session.h"
#include "core/session/pending_edits.h"

namespace scantrove {
namespace {

using JoinJson = nlohmann::ordered_json;

constexpr std::array<std::pair<JoinedObjects::State, const char*>, 3> kJoinStates{
    {{JoinedObjects::State::to_merge, "to merge"},
     {JoinedObjects::State::done, "done"},
     {JoinedObjects::State::to_unmerge, "to part"}}};

const char* wordForState(JoinedObjects::State state) {
  return std::ranges::find(kJoinStates, state, &std::pair<JoinedObjects::State, const char*>::first)->second;
}

std::optional<JoinedObjects::State> joinStateFrom(const std::string& word) {
  for (const auto& [state, known] : kJoinStates) {
    if (word == known) return state;
  }
  return std::nullopt;
}

ObjectId objectFrom(const JoinJson& json) { return ObjectId{json.get<std::uint32_t>()}; }

/// The merge of the two; none: they are merged already, or one was deleted. Users joined the regions, so it
/// does not matter that they named both objects or separated them before.
Result<std::optional<ObjectMerge>> mergeTwo(ObjectDatabase& database, ObjectId a, ObjectId b) {
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  const std::array<ObjectId, 2> roots{catalogue->mergeRoot(a), catalogue->mergeRoot(b)};
  if (!roots[0] || !roots[1] || roots[0] == roots[1]) return std::nullopt;
  return database.merge(roots).map([](ObjectMerge merge) { return std::optional(std::move(merge)); });
}

/// Executes the pending part of one operation in the catalogue; returns the data to store.
Result<std::string> carryOut(ObjectDatabase& database, JoinedObjects joined) {
  if (joined.state == JoinedObjects::State::to_merge) {
    for (const auto& [a, b] : std::exchange(joined.pairs, {})) {
      Result<std::optional<ObjectMerge>> merge = mergeTwo(database, a, b);
      if (!merge) return fail(merge.error());
      if (*merge) joined.merges.push_back(std::move(**merge));
    }
    joined.state = JoinedObjects::State::done;
    return joinedToText(joined);
  }
  for (auto merge = joined.merges.rbegin(); merge != joined.merges.rend(); ++merge)
    SCANTROVE_TRY(database.revertMerge(*merge));
  return std::string();
}

}  // namespace

std::string joinKeyOf(int operation) { return "join " + std::to_string(operation); }

std::string joinedToText(const JoinedObjects& joined) {
  if (joined.before.empty()) return {};
  JoinJson json{{"state", wordForState(joined.state)},
                {"token", joined.token},
                {"before", JoinJson::object()},
                {"pairs", JoinJson::array()},
                {"merges", JoinJson::array()}};
  for (const auto& [region, object] : joined.before)
    json["before"][std::to_string(region.value)] = object.value;
  for (const auto& [a, b] : joined.pairs) json["pairs"].push_back({a.value, b.value});
  for (const ObjectMerge& merge : joined.merges) {
    JoinJson from = JoinJson::array();
    for (const ObjectId object : merge.from) from.push_back(object.value);
    JoinJson one{{"into", merge.into.value}, {"from", from}, {"confirmed", merge.has_confirmed}};
    if (merge.reclassified) one["class"] = reclassifiedToJson(*merge.reclassified);
    json["merges"].push_back(std::move(one));
  }
  return json.dump();
}

JoinedObjects joinedFrom(const std::string& text) {
  if (text.empty()) return {};
  try {
    const JoinJson json = JoinJson::parse(text);
    JoinedObjects joined;
    joined.state = joinStateFrom(json.at("state").get<std::string>()).value_or(JoinedObjects::State::done);
    joined.token = json.value("token", "");
    for (const auto& [region, object] : json.at("before").items())
      joined.before[RegionId{static_cast<std::uint32_t>(std::stoul(region))}] = objectFrom(object);
    for (const JoinJson& pair : json.at("pairs"))
      joined.pairs.emplace_back(objectFrom(pair.at(0)), objectFrom(pair.at(1)));
    for (const JoinJson& one : json.at("merges")) {
      ObjectMerge merge{objectFrom(one.at("into")), {}, one.at("confirmed").get<bool>()};
      for (const JoinJson& from : one.at("from")) merge.from.push_back(objectFrom(from));
      if (one.contains("class")) merge.reclassified = reclassifiedFromJson(one.at("class"));
      if (!merge.from.empty()) joined.merges.push_back(std::move(merge));
    }
    return joined;
  } catch (const std::exception&) {
    return {};
  }
}

int lastOperation(const OperationLog& log, bool is_undone) {
  using State = OperationLog::State;
  const std::vector<OperationLog::Entry>& entries = log.entries();
  const auto done = std::find_if(entries.rbegin(), entries.rend(),
                                 [](const OperationLog::Entry& entry) { return entry.state == State::done; });
  if (!is_undone) return done == entries.rend() ? 0 : done->number;
  // The last undone operation is the first to redo.
  const auto undone =
      std::ranges::find(done.base(), entries.end(), State::undone, &OperationLog::Entry::state);
  return undone == entries.end() ? 0 : undone->number;
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
  joined.token = newToken();
  return joined;
}

bool areJoinsPending(const OpenSession& session) {
  return std::ranges::any_of(session.history().entries(), [&](const OperationLog::Entry& entry) {
    return joinedFrom(session.metadata(joinKeyOf(entry.number))).state != JoinedObjects::State::done;
  });
}

Result<void> mergeJoinedObjects(OpenSession& session, ObjectDatabase& database) {
  for (const OperationLog::Entry& entry : session.history().entries()) {
    const std::string key = joinKeyOf(entry.number);
    const JoinedObjects joined = joinedFrom(session.metadata(key));
    if (joined.state == JoinedObjects::State::done) continue;
    // Sessions of earlier versions stored no token.
    const std::string token = (joined.token.empty() ? newToken() : joined.token) +
                              (joined.state == JoinedObjects::State::to_unmerge ? " undone" : "");
    const Result<std::string> left = database.applyOnce(token, [&] { return carryOut(database, joined); });
    if (!left) return fail(left.error());
    session.setMetadata(key, *left);
    SCANTROVE_TRY(session.saveMetadata());
  }
  return {};
}

}  // namespace scantrove
