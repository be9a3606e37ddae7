#pragma once
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/catalog/object_record.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// What one frame gave for the catalogue.
struct FrameObjects {
  std::vector<SeenObject> seen;
  std::vector<ObjectRecord> added;
  std::vector<ObjectRecord> recognised;  ///< first time in this scan
  std::vector<ObjectId> new_views;       ///< objects that got one
  std::vector<ObjectMerge> merged;       ///< their regions turned out to be one
  /// The catalogue could not be read or written. Said once until it works again; the scan goes on, and what
  /// could not be stored is stored when it is met again.
  std::optional<Error> catalogue_failure;
};

}  // namespace scantrove
