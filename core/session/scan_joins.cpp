#include "core/session/scan_joins.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "core/base/text.h"

namespace scantrove {

void ScanJoins::add(int operation, const RegionEvents& events, const CollectedObjects& objects) {
  std::map<RegionId, ObjectId> keys;
  for (const auto& [into, from] : events.joined) {
    for (const RegionId region : {into, from}) keys[region] = objects.keyOf(region);
  }
  JoinedObjects joined = joinObjects(events, keys);
  if (!joined.before.empty()) joins_[operation] = std::move(joined);
}

ScanJoins::Undone ScanJoins::remove(int operation) {
  Undone undone{std::exchange(joins_[operation], {}).before, {}};
  if (const auto earlier = earlier_.extract(operation)) undone.earlier = earlier.mapped();
  return undone;
}

void ScanJoins::restore(const SessionMetadata& metadata, const CollectedObjects& objects) {
  const std::string start = joinKeyOf(0).substr(0, joinKeyOf(0).size() - 1);
  for (auto entry = metadata.lower_bound(start); entry != metadata.end(); ++entry) {
    if (!entry->first.starts_with(start)) break;
    const std::optional<int> number = parseFrameNumber(entry->first.substr(start.size()));
    JoinedObjects joined = joinedFrom(entry->second);
    if (!number || joined.before.empty() || joined.state != JoinedObjects::State::done) continue;
    for (auto& [region, object] : joined.before) object = objects.keyOfStored(object);
    merges_.insert(merges_.end(), joined.merges.begin(), joined.merges.end());
    earlier_[*number] = joined.merges;
    taken_[entry->first] = entry->second;
    joins_[*number] = std::move(joined);
  }
}

void ScanJoins::addMerges(std::span<const ObjectMerge> merges) {
  if (!joins_.empty()) merges_.insert(merges_.end(), merges.begin(), merges.end());
}

SessionMetadata ScanJoins::takeChanged(const CollectedObjects& objects) {
  SessionMetadata changed;
  for (const auto& [operation, join] : joins_) {
    JoinedObjects done;
    done.token = join.token;
    std::set<ObjectId> joined;
    for (const auto& [region, key] : join.before)
      joined.insert(done.before[region] = objects.storedIdOf(key));
    std::ranges::copy_if(merges_, std::back_inserter(done.merges), [&](const ObjectMerge& merge) {
      return joined.contains(merge.into) &&
             std::ranges::all_of(merge.from, [&](ObjectId from) { return joined.contains(from); });
    });
    std::string text = joinedToText(done);
    const std::string key = joinKeyOf(operation);
    std::string& before = taken_[key];
    if (text == before) continue;
    before = text;
    changed[key] = std::move(text);
  }
  return changed;
}

}  // namespace scantrove
