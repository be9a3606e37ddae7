// What ObjectCollector does about objects that are put elsewhere while the scan runs.
#include <algorithm>
#include <optional>

#include "core/scan/candidate_crop.h"
#include "core/scan/clarity.h"
#include "core/scan/object_collector.h"

namespace scantrove {
namespace {

/// What came into the scene and looks as much like something that was taken away before is that: two things
/// of one size that have little in common differ by 1 and more. Where nothing else is missing, less likeness
/// will do: things are put elsewhere more often than exchanged for others of their size and colour.
constexpr float kBackDistance = 1.0F;
constexpr float kOnlyOneBackDistance = 1.5F;

/// So many looks at what came are held against what turns out to be missing later.
constexpr int kLooksAtWhatCame = 4;

bool isBack(const DetectionMatch& match, std::size_t missing) {
  return match.guess && match.guess_distance < (missing == 1 ? kOnlyOneBackDistance : kBackDistance);
}

}  // namespace

DetectionMatch ObjectCollector::orBack(DetectionMatch match, std::size_t missing) {
  const bool is_most_like = missing == 1 || match.guess_distance <= match.distance;
  if (isBack(match, missing) && is_most_like) {
    match.object = match.guess;
    back_.insert(match.guess);
  }
  return match;
}

bool ObjectCollector::isHeldWith(ObjectId root, const std::set<ObjectId>& objects) const {
  return std::ranges::any_of(objects,
                             [&](ObjectId object) { return catalogue_.mergeRootOf(object) == root; });
}

bool ObjectCollector::hasMoved(ObjectId object) const {
  const ObjectId root = catalogue_.mergeRootOf(object);
  return isHeldWith(root, moved_) || std::ranges::any_of(met_.all(), [&](const auto& met) {
           return MetObjects::wasRemoved(met.second) && catalogue_.mergeRootOf(met.first) == root;
         });
}

/// That a thing was taken away may be seen only after it was put elsewhere, and became another object there.
void ObjectCollector::lookAmongThoseThatCame(const std::vector<Candidate>& candidates, const Look& look) {
  if (appeared_.empty() || look.frame.color.empty()) return;
  const std::vector<ObjectId> missing = missingObjects();
  std::vector<DetectionQuery> queries;
  std::vector<ObjectId> appeared;
  for (const Candidate& candidate : candidates) {
    const auto entry = appeared_.find(met_.objectOf(candidate.regions));
    if (entry == appeared_.end() || !isClear(candidate, kForObject)) continue;
    std::vector<ObjectId> to_compare;
    for (const ObjectId object : missing) {
      if (object != catalogue_.mergeRootOf(entry->first) && entry->second[object]++ < kLooksAtWhatCame)
        to_compare.push_back(object);
    }
    if (to_compare.empty()) continue;
    const std::optional<ObjectView> view =
        cropView(look.frame, look.T_world_camera, look.in_color, candidate);
    if (!view) continue;
    queries.push_back({view->color, view->mask, candidate.size_m, std::move(to_compare)});
    appeared.push_back(entry->first);
  }
  if (queries.empty()) return;
  const std::vector<DetectionMatch> matches = catalogue_.detector().find(queries);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!isBack(matches[i], missing.size())) continue;
    joined_.push_back({matches[i].guess, appeared[i], {}, frame_});
    back_.insert(matches[i].guess);
    appeared_.erase(appeared[i]);
  }
}

std::vector<ObjectId> ObjectCollector::missingObjects() const {
  std::set<ObjectId> missing;
  for (const auto& [object, met] : met_.all()) {
    const ObjectId root = catalogue_.mergeRootOf(object);
    if (root && MetObjects::wasRemoved(met)) missing.insert(root);
  }
  return {missing.begin(), missing.end()};
}

}  // namespace scantrove
