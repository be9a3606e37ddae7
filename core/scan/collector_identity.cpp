// Which objects ObjectCollector holds to be one, and which it doubts.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/scan/candidate_crop.h"
#include "core/scan/object_collector.h"

namespace scantrove {
namespace {

/// Clear looks in a row, of another size than the object's, after which that is not it.
constexpr int kLooksToDoubt = 10;

/// A look is alike where the smaller one of its size and the object's is this part of the larger, seen from
/// one side; from elsewhere another face comes into sight.
constexpr float kAsLargeFromThere = 0.85F, kAsLargeFromElsewhere = 0.7F;
/// From here on it is elsewhere.
constexpr float kElsewhere_deg = 40;

}  // namespace

bool ObjectCollector::isAlike(const ObjectRecord& known, const Candidate& candidate, const Look& look) const {
  if (!isMet(known.id)) return true;
  const Eigen::Vector3f direction = directionOf(candidate, look.T_world_camera);
  // Of the views that are not outdated the one from the nearest side.
  float known_m = known.size_m.norm(), cosine = -1;
  bool has_view = false, has_outdated = false;
  for (const KeptView& view : kept_views_) {
    if (catalogue_.mergeRootOf(view.object) != known.id) continue;
    if (view.is_outdated) {
      has_outdated = true;
    } else if (!has_view || view.direction.dot(direction) > cosine) {
      has_view = true;
      cosine = view.direction.dot(direction);
      known_m = view.diagonal_m;
    }
  }
  if ((!has_view && has_outdated) || known_m == 0) return true;
  constexpr float kRadians = std::numbers::pi_v<float> / 180;
  // Of a set that is larger the other regions may be something else.
  const bool is_set = candidate.regions.size() > 1;
  const float turned = std::acos(std::clamp(cosine, -1.0F, 1.0F)) / (kElsewhere_deg * kRadians);
  const float elsewhere = is_set ? 0 : std::min(turned, 1.0F);
  const float as_large = std::lerp(kAsLargeFromThere, kAsLargeFromElsewhere, elsewhere);
  const float size_m = candidate.size_m.norm();
  return std::min(size_m, known_m) >= as_large * std::max(size_m, known_m);
}

bool ObjectCollector::isOfOtherSize(const ObjectRecord& known, const Candidate& candidate) const {
  const float size_m = candidate.size_m.norm();
  const auto isAsLarge = [&](float known_m) {
    return std::min(size_m, known_m) >= kAsLargeFromElsewhere * std::max(size_m, known_m);
  };
  return !isAsLarge(known.size_m.norm()) && std::ranges::none_of(kept_views_, [&](const KeptView& view) {
    return catalogue_.mergeRootOf(view.object) == known.id && isAsLarge(view.diagonal_m);
  });
}

void ObjectCollector::doubt(const Candidate& candidate, ObjectId object) {
  Doubt& doubt = doubts_[candidate.regions];
  if (doubt.object != object) doubt = {object, 0, 0};
  doubt.last_frame = frame_;
  if (++doubt.observations == kLooksToDoubt) met_.unbind(candidate.regions, object);
}

void ObjectCollector::takePlaceOf(ObjectId doubted, ObjectId object) {
  side_by_side_.insert(std::minmax(doubted, object));
  if (appeared_.contains(doubted)) appeared_.try_emplace(object);
  const ObjectRecord* root = recordOf(catalogue_.mergeRootOf(doubted));
  if (root == nullptr || isSettled(*root) || by_person_.contains(doubted) || met_.hasRegions(doubted)) return;
  const ObjectId last_doubted = successorOf(doubted), last = successorOf(object);
  if (last_doubted != last) successor_[last_doubted] = last;
}

ObjectId ObjectCollector::successorOf(ObjectId object) const {
  for (auto next = successor_.find(object); next != successor_.end(); next = successor_.find(object))
    object = next->second;
  return object;
}

bool ObjectCollector::isDoubted(const RegionSet& regions, ObjectId object) const {
  const auto found = doubts_.find(regions);
  return found != doubts_.end() && found->second.observations >= kLooksToDoubt && object &&
         catalogue_.mergeRootOf(found->second.object) == catalogue_.mergeRootOf(object);
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
    std::vector<ObjectId> there;
    for (const auto& [other, met] : met_.all()) {
      if (!in_view.contains(other) && met_.isAt(other, *candidate) &&
          !isInViewBeside(other, candidate->regions) && !areSideBySide(object, other) &&
          !isOfAnotherWhole(other, candidate->regions) &&
          shouldMerge(catalogue_.mergeRootOf(other), catalogue_.mergeRootOf(object)))
        there.push_back(other);
    }
    // What stands where two do is neither.
    const bool is_several = std::ranges::any_of(there, [&](ObjectId a) {
      return std::ranges::any_of(there, [&](ObjectId b) { return areSideBySide(a, b); });
    });
    if (is_several) continue;
    for (const ObjectId other : there) joined_.push_back({other, object, {}, frame_});
  }
}

bool ObjectCollector::areSideBySide(ObjectId a, ObjectId b) const {
  const ObjectId root_a = catalogue_.mergeRootOf(a), root_b = catalogue_.mergeRootOf(b);
  if (root_a == root_b) return false;
  return std::ranges::any_of(side_by_side_, [&](const auto& pair) {
    const ObjectId first = catalogue_.mergeRootOf(pair.first), second = catalogue_.mergeRootOf(pair.second);
    return (first == root_a && second == root_b) || (first == root_b && second == root_a);
  });
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
  const ObjectRecord* known = recordOf(catalogue_.mergeRootOf(object));
  const bool is_by_person = known != nullptr && (isSettled(*known) || by_person_.contains(object));
  if (by == JoinedBy::frames && known != nullptr && !is_by_person && !met_.objectOf(into)) {
    met_.unbind({from}, object);
    return;
  }
  const auto [kept, gone] = met_.regionsJoined(into, from);
  if (!kept) return;
  if (!catalogue_.mergeRootOf(kept)) {
    met_.bind({into}, gone);  // a deleted one gives way
  } else {
    joined_.push_back({kept, gone, by == JoinedBy::frames ? into : RegionId{}, frame_});
  }
}

void ObjectCollector::regionsParted(RegionId from, RegionId part) {
  std::erase_if(joined_, [from](const Joined& joined) { return joined.region && joined.region == from; });
  const ObjectId object = met_.objectOf(from);
  if (object && !catalogue_.mergeRootOf(object)) met_.bind({part}, object);
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
    const ObjectId a = catalogue_.mergeRootOf(joined->kept);
    const ObjectId b = catalogue_.mergeRootOf(joined->gone);
    // What moved is not what stayed; and of what has other regions only a part was joined to something.
    const bool are_one = !joined->region || (hasMoved(a) == hasMoved(b) && !met_.hasRegions(joined->gone));
    if (!are_one || !shouldMerge(a, b)) continue;
    const bool is_known_again = isMet(a) != isMet(b);  // what was met is what had not been
    catalogue_.merge(a, b);
    writer_->merge(a, b);
    const ObjectId root = catalogue_.mergeRootOf(a);
    if (is_known_again && !CatalogueMirror::isOfThisScan(root)) known_again_.push_back(*recordOf(root));
  }
  joined_.erase(due, joined_.end());
}

}  // namespace scantrove
