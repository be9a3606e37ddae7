#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// What can happen to the catalogue, by a scan, a person or another program.
namespace change {
struct Added {
  ObjectId object;
};
struct ViewAdded {
  ObjectId object;  ///< who held the view when it was stored
  std::int64_t view = 0;
};
struct Renamed {
  ObjectId object;
  std::string name;
};
struct Confirmed {
  ObjectId object;
  bool confirmed = false;
};
struct Removed {
  ObjectId object;
};
struct Restored {
  ObjectId object;
};
struct Merged {
  ObjectId into, from;
};
struct Unmerged {
  ObjectId into, from;
};
/// Some of its views are no longer of it.
struct ViewsDiscarded {
  ObjectId object;
};
}  // namespace change

using CatalogueChange =
    std::variant<change::Added, change::ViewAdded, change::Renamed, change::Confirmed, change::Removed,
                 change::Restored, change::Merged, change::Unmerged, change::ViewsDiscarded>;

/// Changes in the order in which the database took them.
struct CatalogueChanges {
  std::vector<CatalogueChange> changes;
  std::int64_t last_event = 0;  ///< where the next question goes on
};

}  // namespace scantrove
