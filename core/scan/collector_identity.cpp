// Which objects ObjectCollector holds to be one, and which it doubts.
#include <algorithm>
#include <functional>

#include "core/scan/object_collector.h"

namespace scantrove {
namespace {

/// Clear looks in a row, of another size than the object's, after which that is not it.
constexpr int kLooksToDoubt = 10;

}  // namespace

void ObjectCollector::doubt(const Candidate& candidate, ObjectId object) {
  Doubt& doubt = doubts_[candidate.regions];
  if (doubt.object != object) doubt = {object, 0, 0};
  doubt.last_frame = frame_;
  if (++doubt.looks == kLooksToDoubt) met_.unbind(candidate.regions, object);
}

void ObjectCollector::takePlaceOf(ObjectId doubted, ObjectId object) {
  side_by_side_.insert(std::minmax(doubted, object));
  if (came_.contains(doubted)) came_.try_emplace(object);
  const ObjectRecord* holder = recordOf(catalogue_.holderOf(doubted));
  if (holder == nullptr || isSettled(*holder) || by_person_.contains(doubted) || met_.hasRegions(doubted))
    return;
  for (KeptView& view : kept_views_) view.is_outdated = view.is_outdated || view.object == doubted;
}

bool ObjectCollector::isDoubted(const RegionSet& regions, ObjectId object) const {
  const auto found = doubts_.find(regions);
  return found != doubts_.end() && found->second.looks >= kLooksToDoubt && object &&
         catalogue_.holderOf(found->second.object) == catalogue_.holderOf(object);
}

/// Two objects at one place are one, the second was met under other regions; those that were ever seen side
/// by side are two.
void ObjectCollector::joinDoubles(const std::vector<const Candidate*>& chosen) {
  std::set<ObjectId> in_view;
  for (const Candidate* candidate : chosen) in_view.insert(met_.objectOf(candidate->regions));
  in_view.erase(ObjectId{});
  for (const ObjectId a : in_view) {
    for (const ObjectId b : in_view) {
      if (a < b) side_by_side_.emplace(a, b);
    }
  }
  for (const Candidate* candidate : chosen) {
    const ObjectId object = met_.objectOf(candidate->regions);
    if (!object) continue;
    for (const auto& [other, met] : met_.all()) {
      if (in_view.contains(other) || side_by_side_.contains(std::minmax(object, other))) continue;
      if (met_.isAt(other, *candidate) &&
          shouldMerge(catalogue_.holderOf(other), catalogue_.holderOf(object)))
        joined_.push_back({other, object, {}, frame_});
    }
  }
}

void ObjectCollector::regionsJoined(RegionId into, RegionId from, JoinedBy by) {
  recognition_.forgetRegion(from);
  std::erase_if(doubts_,
                [&](const auto& entry) { return entry.first.contains(from) || entry.first.contains(into); });
  for (Joined& joined : joined_) {
    if (joined.region == from) joined.region = into;
  }
  followWanted(into, from);
  // A rest of what was taken away says nothing of what it is counted to now. What is there is known again by
  // its place.
  const ObjectId object = met_.objectOf(from);
  const ObjectRecord* known = recordOf(catalogue_.holderOf(object));
  const bool is_by_person = known != nullptr && (isSettled(*known) || by_person_.contains(object));
  if (by == JoinedBy::frames && known != nullptr && !is_by_person && !met_.objectOf(into)) {
    met_.unbind({from}, object);
    return;
  }
  const auto [kept, gone] = met_.regionsJoined(into, from);
  if (!kept) return;
  if (!catalogue_.holderOf(kept)) {
    met_.bind({into}, gone);  // a deleted one gives way
  } else {
    joined_.push_back({kept, gone, by == JoinedBy::frames ? into : RegionId{}, frame_});
  }
}

void ObjectCollector::regionsParted(RegionId from, RegionId part) {
  std::erase_if(joined_, [from](const Joined& joined) { return joined.region && joined.region == from; });
  const ObjectId object = met_.objectOf(from);
  if (object && !catalogue_.holderOf(object)) met_.bind({part}, object);
}

bool ObjectCollector::shouldMerge(ObjectId a, ObjectId b) const {
  const ObjectRecord* first = recordOf(a);
  const ObjectRecord* second = recordOf(b);
  if (first == nullptr || second == nullptr || a == b || catalogue_.areKeptApart(a, b)) return false;
  return !(isSettled(*first) && isSettled(*second));
}

void ObjectCollector::mergeJoined(Which which) {
  const auto isDue = [&](const Joined& joined) {
    return which == Which::all || !joined.region || frame_ - joined.frame >= kFramesToBeOne;
  };
  const auto due = std::stable_partition(joined_.begin(), joined_.end(), std::not_fn(isDue));
  for (auto joined = joined_.end(); joined != due;) {
    --joined;  // the newest first
    const ObjectId a = catalogue_.holderOf(joined->kept);
    const ObjectId b = catalogue_.holderOf(joined->gone);
    const bool is_one_place = !joined->region || hasMoved(a) == hasMoved(b);  // what moved is not what stayed
    if (!is_one_place || !shouldMerge(a, b)) continue;
    catalogue_.merge(a, b);
    writer_->merge(a, b);
  }
  joined_.erase(due, joined_.end());
}

}  // namespace scantrove
