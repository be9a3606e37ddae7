#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"
#include "core/collection/seen_object.h"

namespace scantrove {

/// An object with its current name.
struct NamedObject {
  ObjectId object;
  std::string name;
};

/// What one frame added to the catalogue, and what has been stored since the last frame.
struct FrameObjects {
  std::vector<SeenObject> seen;
  std::vector<ObjectRecord> recognized;  ///< observed for the first time in this scan

  bool is_catalogue_changed = false;  ///< through this scan or others
  std::vector<ObjectRecord> added;    ///< stored
  std::vector<ObjectId> new_views;    ///< objects that got one; stored
  std::vector<ObjectMerge> merged;    ///< their regions belong to one object; stored
  std::vector<ObjectId> removed;      ///< their views show something else
  std::vector<NamedObject> named;     ///< by a user who named a region; stored
  /// The catalogue could not be read or written. Reported once until it works again; the scan goes on, and
  /// unstored data waits.
  std::optional<Error> catalogue_failure;
};

}  // namespace scantrove
