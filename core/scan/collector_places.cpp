// What ObjectCollector knows of objects because earlier scans saw the same place.
#include <algorithm>

#include "core/scan/object_collector.h"

namespace scantrove {
namespace {

/// What is expected is as large as the known one where the smaller of their sizes is this part of the larger.
constexpr float kAsLarge = 0.7F;

}  // namespace

void ObjectCollector::alignWithEarlierScans() {
  std::vector<KnownLayouts::ObjectPosition> recognized;
  for (const auto& [object, met] : met_.all()) {
    const ObjectId root = catalogue_.mergeRootOf(object);
    if (root && !CatalogueMirror::isOfThisScan(root) && !MetObjects::wasRemoved(met))
      recognized.push_back({root, met.centroid_world});
  }
  catalogue_.places().align(recognized, [this](ObjectId object) { return catalogue_.mergeRootOf(object); });
}

std::vector<ObjectId> ObjectCollector::expectedAt(const Candidate& candidate) const {
  std::vector<ObjectId> objects = catalogue_.places().expectedAt(candidate.centroid_world);
  std::erase_if(objects, [&](ObjectId object) {
    const ObjectRecord* known = recordOf(object);
    if (known == nullptr || isMet(object)) return true;
    const float known_m = known->size_m.norm(), size_m = candidate.size_m.norm();
    return std::min(known_m, size_m) < kAsLarge * std::max(known_m, size_m);
  });
  return objects;
}

DetectionMatch ObjectCollector::orExpected(DetectionMatch match) {
  if (!match.object && match.guess && match.guess_distance < kExpectedDistance) match.object = match.guess;
  return match;
}

}  // namespace scantrove
