#include "core/catalogue/alike_objects.h"

#include <algorithm>
#include <map>

#include "core/catalogue/match_distance.h"
#include "core/catalogue/view_index.h"
#include "core/catalogue/warped_thumbnail.h"

namespace scantrove {
namespace {

/// The views of one object, and the index of all others.
struct ComparedViews {
  std::vector<const StoredDescriptor*> own, others;  // others: by their place in the index
  ViewIndex index;

  ComparedViews(ObjectId object, std::span<const StoredDescriptor> views, const CatalogueModel& catalogue) {
    for (const StoredDescriptor& view : views) {
      const ObjectId root = catalogue.mergeRoot(view.first_object);
      if (root == object) own.push_back(&view);
      if (!root || root == object) continue;
      index.setMergeRoot({view.first_object, root});
      index.append(view.first_object, view.descriptor, view.size_m);
      others.push_back(&view);
    }
  }
};

/// The distances of all compared objects from one view.
std::map<ObjectId, float> distancesFrom(const StoredDescriptor& view, ComparedViews& compared) {
  const ViewIndex::Query query{view.descriptor, view.size_m};
  const WarpedThumbnail warped(view.descriptor.thumbnail);
  std::map<ObjectId, std::vector<float>> of_views;
  for (const int place : compared.index.shortlist(query, DetectionParams{}.shortlist)) {
    ViewDifference difference = compared.index.difference(query, place);
    difference.shape =
        warped.distanceTo(compared.others[static_cast<std::size_t>(place)]->descriptor.thumbnail);
    of_views[compared.index.mergeRootAt(place)].push_back(matchDistance(difference));
  }
  std::map<ObjectId, float> of_objects;
  for (auto& [object, distances] : of_views) of_objects.emplace(object, objectDistance(std::move(distances)));
  return of_objects;
}

/// The roots that a user keeps apart from `object`.
std::set<ObjectId> keptApartFrom(ObjectId object, const CatalogueModel& catalogue,
                                 const std::set<ObjectPair>& different) {
  std::set<ObjectId> apart;
  for (const auto& [a, b] : different) {
    const ObjectId root_a = catalogue.mergeRoot(a), root_b = catalogue.mergeRoot(b);
    if (root_a == object) apart.insert(root_b);
    if (root_b == object) apart.insert(root_a);
  }
  return apart;
}

}  // namespace

std::vector<AlikeObject> findAlikeObjects(ObjectId object, std::span<const StoredDescriptor> views,
                                          const CatalogueModel& catalogue,
                                          const std::set<ObjectPair>& different) {
  ComparedViews compared(object, views, catalogue);
  std::map<ObjectId, std::vector<float>> from_views;
  for (const StoredDescriptor* view : compared.own) {
    for (const auto& [other, distance] : distancesFrom(*view, compared))
      from_views[other].push_back(distance);
  }
  std::vector<AlikeObject> ranked;
  for (auto& [other, distances] : from_views) ranked.push_back({other, objectDistance(std::move(distances))});
  std::ranges::stable_sort(ranked, {}, &AlikeObject::distance);

  const std::set<ObjectId> apart = keptApartFrom(object, catalogue, different);
  const int all = compared.index.countObjects(kObjectsToCompare + static_cast<int>(kMostAlike));
  std::vector<AlikeObject> alike;
  for (std::size_t i = 0; i < ranked.size() && alike.size() < kMostAlike; ++i) {
    if (apart.contains(ranked[i].object)) continue;
    std::vector<float> farther;
    for (std::size_t j = i + 1; j < ranked.size(); ++j) farther.push_back(ranked[j].distance);
    const float distance =
        relativeDistance(ranked[i].distance, std::move(farther), all - static_cast<int>(i));
    if (distance < kAlikeDistance) alike.push_back({ranked[i].object, distance});
  }
  return alike;
}

}  // namespace scantrove
