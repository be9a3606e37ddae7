#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"
#include "core/collection/seen_object.h"

namespace scantrove {

/// An object as it is called now.
struct NamedObject {
  ObjectId object;
  std::string name;
};

/// What one frame gave to the catalogue, and what of this and earlier frames is stored by now.
struct FrameObjects {
  std::vector<SeenObject> seen;
  std::vector<ObjectRecord> recognized;  ///< first time in this scan

  bool has_events = false;          ///< the catalogue changed, through this scan or others
  std::vector<ObjectRecord> added;  ///< stored
  std::vector<ObjectId> new_views;  ///< objects that got one; stored
  std::vector<ObjectMerge> merged;  ///< their regions turned out to be one; stored
  std::vector<ObjectId> left;       ///< removed: their views show something else by now
  std::vector<NamedObject> named;   ///< by a user who named a region; stored
  /// The catalogue could not be read or written. Said once until it works again; the scan goes on, and what
  /// could not be stored waits.
  std::optional<Error> catalogue_failure;
};

}  // namespace scantrove
