#pragma once
#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// One change of one object. CatalogueModel decides changes, the database stores them as events, and
/// running scans and the window follow them.
struct CatalogueChange {
  enum class Kind : std::uint8_t {
    added,
    view_added,
    renamed,
    confirmed,
    unconfirmed,
    removed,
    restored,
    merged,
    unmerged,
    views_discarded  ///< some of its views belong to another object now
  };
  Kind kind = Kind::added;
  ObjectState before, after;  ///< of one object; added objects and views have only their id
  std::int64_t view = 0;      ///< of view_added
  ObjectId part = {};         ///< of views_discarded by an unmerge: the object that has the views now

  [[nodiscard]] ObjectId object() const { return after.id; }
  /// The other object of a merge or unmerge; none for other kinds.
  [[nodiscard]] ObjectId mergeTarget() const {
    return kind == Kind::unmerged ? before.merged_into : after.merged_into;
  }
  /// Whether views changed their owner, or an object was deleted or restored.
  [[nodiscard]] bool movesViews() const {
    return kind == Kind::removed || kind == Kind::restored || kind == Kind::merged || kind == Kind::unmerged;
  }
};

/// Changes in the order in which the database committed them.
struct CatalogueChanges {
  std::vector<CatalogueChange> changes;
  std::int64_t last_event = 0;  ///< where the next query continues
};

}  // namespace scantrove
