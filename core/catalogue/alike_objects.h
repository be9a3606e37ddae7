#pragma once
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/catalogue_model.h"
#include "core/catalogue/detection_params.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// Two objects, the smaller id first.
using ObjectPair = std::pair<ObjectId, ObjectId>;

/// An object that may be the same thing as another one.
struct AlikeObject {
  ObjectId object;
  float distance = 2;  ///< judged by the runners-up (relativeDistance)

  /// The program would recognise the one as the other: recognition has this limit.
  [[nodiscard]] bool isVeryAlike() const { return distance < DetectionParams{}.max_distance; }
};

/// Distance up to which objects are alike. Unrelated ones begin at 0.6 and most differ by 1, and a person
/// decides here at the cost of one glance; so the limit is where unrelated ones are still few.
inline constexpr float kAlikeDistance = 0.7F;
inline constexpr std::size_t kMostAlike = 5;

/// The objects whose views resemble those of `object` most, nearest first, at most kMostAlike. Recognition
/// compares each of its views: ViewIndex prunes, matchDistance() compares, and relativeDistance() judges each
/// object by those that are farther, so that two duplicates do not hide each other.
/// `views`: of the whole catalogue (ViewStore::forEachDescriptor). `different`: pairs that a user keeps
/// apart, by any of the ids that were merged; they are left out, and still count as runners-up. Without a
/// device: a tenth of a second for 20 views. Any thread.
[[nodiscard]] std::vector<AlikeObject> findAlikeObjects(ObjectId object,
                                                        std::span<const StoredDescriptor> views,
                                                        const CatalogueModel& catalogue,
                                                        const std::set<ObjectPair>& different);

}  // namespace scantrove
