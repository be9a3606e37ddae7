#pragma once
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/region_object.h"
#include "core/collection/collected_object.h"
#include "core/collection/object_tracks.h"
#include "core/collection/seen_object.h"

namespace scantrove {

/// What the catalogue says now of the objects that a scan follows, by the ids of the database: for lists,
/// labels and reports.
class CollectedObjects {
 public:
  /// Both outlive it.
  CollectedObjects(const CatalogueMirror& catalogue, const ObjectTracks& tracks)
      : catalogue_(catalogue), tracks_(tracks) {}

  /// Objects observed in this scan that the catalogue has, by id.
  [[nodiscard]] std::vector<CollectedObject> list() const;
  /// The object that a region is, or none: unknown, not stored yet, or deleted by a user.
  [[nodiscard]] ObjectId idOf(RegionId region) const;
  /// The scan's key of it, stored or not; and the id of what has that key, none: it is not stored.
  [[nodiscard]] ObjectId keyOf(RegionId region) const {
    return catalogue_.mergeRootOf(tracks_.objectOf(region));
  }
  [[nodiscard]] ObjectId storedIdOf(ObjectId key) const { return catalogue_.idOf(key); }
  /// The same with what the catalogue says of it.
  [[nodiscard]] RegionObject describe(RegionId region) const;
  /// Fills in the object of `seen.regions`.
  void describe(SeenObject& seen) const;

 private:
  const CatalogueMirror& catalogue_;
  const ObjectTracks& tracks_;
};

}  // namespace scantrove
