#include "core/collection/identity_resolver.h"

#include <algorithm>
#include <functional>

namespace scantrove {
namespace {

/// An object observed within so many frames still has regions of its own.
constexpr int kFramesToReturn = 10;
/// An object seen elsewhere within so many frames is not here.
constexpr int kFramesToMove = 90;
/// Clear observations of another size in a row, after which the regions are no longer the object.
constexpr int kMismatches = 10;

}  // namespace

ObjectId IdentityResolver::identityOf(const Candidate& candidate, std::optional<ObjectId> verdict, int frame,
                                      bool is_refining) const {
  if (const ObjectId object = tracks_.objectOf(candidate.regions)) return object;
  const std::string* requested_name = requests_.requestedName(candidate);
  // The same object under a new region.
  const ObjectId before = nearby(candidate, frame);
  if (const ObjectId object = isMismatched(candidate.regions, before) ? ObjectId{} : before) {
    // An object that a user deleted is added again only on request.
    if (requested_name == nullptr) return object;
    if (catalogue_.mergeRootOf(object) && !requests_.isExcluded(*candidate.regions.begin(), object))
      return object;
  }
  if (requested_name != nullptr && !requested_name->empty())
    return {};  // a requested name outweighs the appearance
  const ObjectRecord* known = verdict ? catalogue_.currentRecord(*verdict) : nullptr;
  if (known == nullptr || isMismatched(candidate.regions, known->id) ||
      isOtherSet(known->id, candidate.regions))
    return {};
  // An object seen elsewhere a moment ago is another object of the same appearance.
  for (const auto& [object, track] : tracks_.all()) {
    if (catalogue_.mergeRootOf(object) == known->id &&
        (is_refining || frame - track.last_frame < kFramesToMove) && !track.isMissing() &&
        !tracks_.isAt(object, candidate))
      return {};
  }
  return known->id;
}

ObjectId IdentityResolver::nearby(const Candidate& candidate, int frame) const {
  return tracks_.nearest(candidate, frame - kFramesToReturn, [&](ObjectId object) {
    return !tracks_.isInViewBeside(object, candidate.regions) && !isOtherSet(object, candidate.regions);
  });
}

void IdentityResolver::countMismatch(const Candidate& candidate, ObjectId object, int frame) {
  Mismatch& mismatch = state_.mismatches[candidate.regions];
  if (mismatch.object != object) mismatch = {object, 0, 0};
  mismatch.last_frame = frame;
  if (++mismatch.count == kMismatches) tracks_.unbind(candidate.regions, object);
}

ObjectId IdentityResolver::mismatchOf(const RegionSet& regions) const {
  const auto found = state_.mismatches.find(regions);
  return found == state_.mismatches.end() ? ObjectId{} : found->second.object;
}

bool IdentityResolver::isMismatched(const RegionSet& regions, ObjectId object) const {
  const auto found = state_.mismatches.find(regions);
  return found != state_.mismatches.end() && found->second.count >= kMismatches && object &&
         catalogue_.mergeRootOf(found->second.object) == catalogue_.mergeRootOf(object);
}

void IdentityResolver::replace(ObjectId mismatched, ObjectId object) {
  state_.seen_together.insert(std::minmax(mismatched, object));
  const ObjectRecord* record = catalogue_.currentRecord(mismatched);
  if (record == nullptr || isSettled(*record) || requests_.isRequested(mismatched) ||
      tracks_.hasRegions(mismatched))
    return;
  const ObjectId last_mismatched = replacementOf(mismatched), last = replacementOf(object);
  if (last_mismatched != last) state_.replaced_by[last_mismatched] = last;
}

ObjectId IdentityResolver::replacementOf(ObjectId object) const {
  const auto& next_of = state_.replaced_by;
  for (auto next = next_of.find(object); next != next_of.end(); next = next_of.find(object))
    object = next->second;
  return object;
}

bool IdentityResolver::haveOneReplacement(ObjectId a, ObjectId b) const {
  const ObjectId root = catalogue_.mergeRootOf(replacementOf(a));
  return root && root == catalogue_.mergeRootOf(replacementOf(b));
}

void IdentityResolver::mergeReplaced(std::span<const ObjectId> with_views) {
  for (const ObjectId object : with_views) {
    const ObjectId root = catalogue_.mergeRootOf(object);
    const ObjectId last = catalogue_.mergeRootOf(replacementOf(object));
    if (catalogue_.model().mayMerge(last, root)) mergeNow(last, root);
  }
}

void IdentityResolver::forgetBefore(int frame) {
  std::erase_if(state_.mismatches, [frame](const auto& entry) { return entry.second.last_frame < frame; });
}

void IdentityResolver::mergeDuplicates(const std::vector<const Candidate*>& observed, int frame) {
  std::set<ObjectId> in_view;
  for (const Candidate* candidate : observed) in_view.insert(tracks_.objectOf(candidate->regions));
  in_view.erase(ObjectId{});
  for (const ObjectId a : in_view) {
    for (const ObjectId b : in_view) {
      if (a < b) state_.seen_together.emplace(a, b);
    }
  }
  for (const Candidate* candidate : observed) {
    const ObjectId object = tracks_.objectOf(candidate->regions);
    if (!object) continue;
    std::vector<ObjectId> there;
    for (const auto& [other, track] : tracks_.all()) {
      if (!in_view.contains(other) && tracks_.isAt(other, *candidate) &&
          !tracks_.isInViewBeside(other, candidate->regions) && !areSeenTogether(object, other) &&
          !isOtherSet(other, candidate->regions) &&
          catalogue_.model().mayMerge(catalogue_.mergeRootOf(other), catalogue_.mergeRootOf(object)))
        there.push_back(other);
    }
    // A candidate at the place of two objects is neither of them.
    const bool is_several = std::ranges::any_of(there, [&](ObjectId a) {
      return std::ranges::any_of(there, [&](ObjectId b) { return areSeenTogether(a, b); });
    });
    if (is_several) continue;
    for (const ObjectId other : there) requestMerge({other, object}, frame);
  }
}

bool IdentityResolver::areSeenTogether(ObjectId a, ObjectId b) const {
  const ObjectId root_a = catalogue_.mergeRootOf(a), root_b = catalogue_.mergeRootOf(b);
  if (root_a == root_b) return false;
  return std::ranges::any_of(state_.seen_together, [&](const auto& pair) {
    const ObjectId first = catalogue_.mergeRootOf(pair.first), second = catalogue_.mergeRootOf(pair.second);
    return (first == root_a && second == root_b) || (first == root_b && second == root_a);
  });
}

void IdentityResolver::joinRegions(RegionId into, RegionId from, JoinedBy by, int frame, int operation) {
  std::erase_if(state_.mismatches,
                [&](const auto& entry) { return entry.first.contains(from) || entry.first.contains(into); });
  for (Join& join : joins_) {
    if (join.region == from) join.region = into;
  }
  // The remnant of a removed object does not identify the region that now contains it. The object is found
  // again by its place.
  const ObjectId object = tracks_.objectOf(from);
  const ObjectRecord* record = catalogue_.currentRecord(object);
  const bool is_by_user = record != nullptr && (isSettled(*record) || requests_.isRequested(object));
  if (by == JoinedBy::frames && record != nullptr && !is_by_user && !tracks_.objectOf(into)) {
    tracks_.unbind({from}, object);
    return;
  }
  const auto [kept, gone] = tracks_.joinRegions(into, from);
  if (!kept) return;
  const ObjectId root = catalogue_.mergeRootOf(kept), other = catalogue_.mergeRootOf(gone);
  if (!root) {
    tracks_.bind({into}, gone);  // the other object was deleted
  } else if (operation != 0) {
    if (other && other != root) mergeRecognized(root, other, operation);
  } else {
    joins_.push_back({kept, gone, by == JoinedBy::frames ? into : RegionId{}, frame});
  }
}

void IdentityResolver::splitRegion(RegionId from, RegionId part) {
  std::erase_if(joins_, [from](const Join& join) { return join.region && join.region == from; });
  const ObjectId object = tracks_.objectOf(from);
  if (object && !catalogue_.mergeRootOf(object)) tracks_.bind({part}, object);
}

void IdentityResolver::partRegions(int operation, const std::map<RegionId, ObjectId>& objects,
                                   std::vector<ObjectMerge> earlier) {
  for (const auto& [region, object] : objects) tracks_.bind({region}, object);
  writer_.part(operation, std::move(earlier));
}

void IdentityResolver::mergeNow(ObjectId a, ObjectId b, int join) {
  catalogue_.merge(a, b);
  writer_.merge(a, b, join);
}

void IdentityResolver::mergeRecognized(ObjectId a, ObjectId b, int join) {
  const bool is_recognized = tracks_.isObserved(a) != tracks_.isObserved(b);
  mergeNow(a, b, join);
  const ObjectId root = catalogue_.mergeRootOf(a);
  if (is_recognized && !CatalogueMirror::isOfThisScan(root)) recognized_.push_back(*catalogue_.record(root));
}

void IdentityResolver::merge(Which which, int frame) {
  const auto isDue = [&](const Join& join) {
    return which == Which::all || !join.region || frame - join.frame >= kFramesToMerge;
  };
  const auto due = std::stable_partition(joins_.begin(), joins_.end(), std::not_fn(isDue));
  for (auto join = joins_.end(); join != due;) {
    --join;  // newest first
    const ObjectId a = catalogue_.mergeRootOf(join->kept);
    const ObjectId b = catalogue_.mergeRootOf(join->gone);
    // A moved object differs from one that stayed. Of an object with other regions only a part was joined.
    const bool are_one =
        !join->region || (tracks_.hasMoved(a) == tracks_.hasMoved(b) && !tracks_.hasRegions(join->gone));
    if (!are_one || !catalogue_.model().mayMerge(a, b)) continue;
    mergeRecognized(a, b);
  }
  joins_.erase(due, joins_.end());
}

bool IdentityResolver::isOtherSet(ObjectId object, const RegionSet& regions) const {
  const ObjectId root = catalogue_.mergeRootOf(object);
  if (!root || requests_.isFixed(object)) return false;
  return std::ranges::any_of(state_.complete, [&](const auto& set) {
    return set.first != regions && catalogue_.mergeRootOf(tracks_.objectOf(set.first)) == root;
  });
}

void IdentityResolver::settle(std::span<const CompleteSet> complete) {
  std::set<ObjectId> taken_roots;
  for (const auto& [regions, best_frame] : complete) {
    std::vector<ObjectId> objects;  // identified for its regions
    for (const RegionId region : regions) {
      const ObjectId object = tracks_.objectOf(region);
      if (object && !std::ranges::count(objects, object)) objects.push_back(object);
    }
    // A deleted object stays deleted.
    if (!std::ranges::all_of(objects, [this](ObjectId object) { return !!catalogue_.mergeRootOf(object); }))
      continue;
    // Objects that a user edited come first, and stay separate.
    std::stable_partition(objects.begin(), objects.end(),
                          [this](ObjectId object) { return requests_.isFixed(object); });
    if (objects.size() > 1 && requests_.isFixed(objects[1])) continue;
    state_.complete.emplace(regions, best_frame);
    for (const ObjectId object : objects) tracks_.unbind(regions, object);
    // Only a user may merge two sets.
    std::erase_if(objects, [&](ObjectId object) {
      return !requests_.isFixed(object) && taken_roots.contains(catalogue_.mergeRootOf(object));
    });
    if (objects.empty()) continue;
    // An object that is complete was not replaced.
    const bool is_with_replacement = std::any_of(objects.begin() + 1, objects.end(), [&](ObjectId object) {
      return replacementOf(object) == replacementOf(objects.front());
    });
    if (!is_with_replacement) state_.replaced_by.erase(objects.front());
    tracks_.bind(regions, objects.front());
    taken_roots.insert(catalogue_.mergeRootOf(objects.front()));
  }
}

}  // namespace scantrove
