#include "app/recording_outcome.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "app/command.h"

namespace scantrove {
namespace {

using OutcomeKind = RecordingOutcome::Kind;

constexpr std::array kOutcomeNames{
    std::pair{OutcomeKind::done, "done"}, std::pair{OutcomeKind::stopped, "stopped"},
    std::pair{OutcomeKind::skipped, "skipped"}, std::pair{OutcomeKind::failed, "failed"},
    std::pair{OutcomeKind::left, "left"}};

const char* wordFor(OutcomeKind kind) {
  const auto* const found =
      std::ranges::find(kOutcomeNames, kind, &std::pair<OutcomeKind, const char*>::first);
  return found->second;
}

std::ptrdiff_t countOf(const std::vector<RecordingOutcome>& outcomes, OutcomeKind kind) {
  return std::ranges::count(outcomes, kind, &RecordingOutcome::kind);
}

}  // namespace

Json toJson(const RecordingOutcome& outcome) {
  Json json{{"source", outcome.source}, {"outcome", wordFor(outcome.kind)}};
  if (!outcome.reason.empty()) json["reason"] = outcome.reason;
  if (!outcome.scan.empty()) json["scan"] = outcome.scan;
  if (outcome.kind != OutcomeKind::done && outcome.kind != OutcomeKind::stopped) return json;
  json["continued"] = outcome.is_continued;
  json["frames"] = {{"read", outcome.read}, {"tracked", outcome.tracked}};
  json["regions"] = outcome.regions;
  json["objects"] = outcome.objects;
  return json;
}

std::optional<RecordingOutcome> outcomeFrom(const Json& json) {
  if (!json.is_object()) return std::nullopt;
  try {
    RecordingOutcome outcome;
    outcome.source = json.at("source").get<std::string>();
    const auto name = json.at("outcome").get<std::string>();
    const auto* const kind =
        std::ranges::find_if(kOutcomeNames, [&](const auto& known) { return name == known.second; });
    if (kind == kOutcomeNames.end()) return std::nullopt;
    outcome.kind = kind->first;
    outcome.reason = json.value("reason", "");
    outcome.scan = json.value("scan", "");
    outcome.is_continued = json.value("continued", false);
    outcome.regions = json.value("regions", 0);
    outcome.objects = json.value("objects", 0);
    const Json frames = json.value("frames", Json::object());
    outcome.read = frames.value("read", 0);
    outcome.tracked = frames.value("tracked", 0);
    return outcome;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::string toLine(const RecordingOutcome& outcome) {
  const std::string source = inLine(outcome.source);
  switch (outcome.kind) {
    case OutcomeKind::skipped:
      return "skipped  " + source + ": " + inLine(outcome.reason);
    case OutcomeKind::failed:
      return "failed   " + source + ": " + inLine(outcome.reason);
    case OutcomeKind::left:
      return "left     " + source;
    case OutcomeKind::done:
    case OutcomeKind::stopped:
      break;
  }
  std::ostringstream line;
  line << (outcome.kind == OutcomeKind::stopped ? "stopped  "
           : outcome.is_continued               ? "resumed  "
                                                : "scanned  ")
       << source << ": " << outcome.tracked << " of " << outcome.read << " frames tracked, "
       << outcome.regions << " regions, " << outcome.objects << " objects";
  return line.str();
}

Json toJson(const std::vector<RecordingOutcome>& outcomes) {
  Json json = Json::object();
  for (const auto& [kind, name] : kOutcomeNames) json[name] = countOf(outcomes, kind);
  json["recordings"] = Json::array();
  for (const RecordingOutcome& outcome : outcomes) json["recordings"].push_back(toJson(outcome));
  return json;
}

std::string toSummary(const std::vector<RecordingOutcome>& outcomes) {
  std::ostringstream text;
  if (outcomes.size() > 1) {
    for (const RecordingOutcome& outcome : outcomes)
      if (outcome.kind == OutcomeKind::failed) text << toLine(outcome) << '\n';
  }
  text << "project  " << countOf(outcomes, OutcomeKind::done) << " scanned, "
       << countOf(outcomes, OutcomeKind::skipped) << " skipped, " << countOf(outcomes, OutcomeKind::failed)
       << " failed, ";
  if (const auto stopped = countOf(outcomes, OutcomeKind::stopped); stopped > 0)
    text << stopped << " stopped, ";
  if (const auto left = countOf(outcomes, OutcomeKind::left); left > 0) text << left << " left, ";
  text << "of " << outcomes.size() << '\n';
  return text.str();
}

Result<void> checkOutcomes(const std::vector<RecordingOutcome>& outcomes) {
  const auto failed = countOf(outcomes, OutcomeKind::failed);
  if (failed == 0) return {};
  if (outcomes.size() == 1) return fail(outcomes.front().reason);
  return fail(std::to_string(failed) + " of " + std::to_string(outcomes.size()) +
                  " recordings could not be scanned; the reasons stand above.",
              "Run the same command again after mending them; what is scanned is skipped.");
}

}  // namespace scantrove
