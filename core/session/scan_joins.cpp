#include "core/session/scan_joins.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace scantrove {

void ScanJoins::add(int operation, const RegionEvents& events, const CollectedObjects& objects) {
  std::map<RegionId, ObjectId> keys;
  for (const auto& [into, from] : events.joined) {
    for (const RegionId region : {into, from}) keys[region] = objects.keyOf(region);
  }
  JoinedObjects joined = joinObjects(events, keys);
  if (!joined.before.empty()) joins_[operation] = std::move(joined);
}

void ScanJoins::remove(int operation) { joins_[operation] = {}; }

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
