#pragma once
#include <vector>

#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/region_object.h"
#include "core/collection/collected_object.h"
#include "core/collection/object_tracks.h"
#include "core/collection/seen_object.h"

namespace scantrove {

/// The catalogue's current data about the tracked objects, by database id: for lists, labels and reports.
class CollectedObjects {
 public:
  /// Both outlive this.
  CollectedObjects(const CatalogueMirror& catalogue, const ObjectTracks& tracks)
      : catalogue_(catalogue), tracks_(tracks) {}

  /// Objects of the catalogue that this scan has observed, by id.
  [[nodiscard]] std::vector<CollectedObject> list() const;
  /// The object of the region; none: unknown, not stored yet, or deleted by a user.
  [[nodiscard]] ObjectId idOf(RegionId region) const;
  /// The scan's key of the region's object, stored or not. The next function gives the id for a key; none:
  /// not stored.
  [[nodiscard]] ObjectId keyOf(RegionId region) const {
    return catalogue_.mergeRootOf(tracks_.objectOf(region));
  }
  [[nodiscard]] ObjectId storedIdOf(ObjectId key) const { return catalogue_.idOf(key); }
  [[nodiscard]] ObjectId keyOfStored(ObjectId id) const { return catalogue_.keyOf(id); }
  /// As above, with the catalogue's record.
  [[nodiscard]] RegionObject describe(RegionId region) const;
  /// Fills in `seen.object` and its record from `seen.regions`.
  void describe(SeenObject& seen) const;

 private:
  const CatalogueMirror& catalogue_;
  const ObjectTracks& tracks_;
};

}  // namespace scantrove
