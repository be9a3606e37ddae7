#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// A change of one class.
struct ClassChange {
  ObjectClass before, after;  ///< of an added class `before` has no id
};

/// One change of one object or one class. CatalogueModel decides changes, the database stores them as events,
/// and running scans and the window follow them.
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
    views_discarded,  ///< some of its views belong to another object now
    classified,       ///< an object has another class or other answers
    class_added,
    class_edited,  ///< name, color, supercategory or attributes
    class_hidden,
    class_restored,
    class_merged,
    class_unmerged
  };
  Kind kind = Kind::added;
  /// Of one object; added objects and views have only their id. Changes of classes have no object.
  ObjectState before, after;
  std::int64_t view = 0;  ///< of view_added
  ObjectId part = {};     ///< of views_discarded by an unmerge: the object that has the views now
  std::optional<ClassChange> of_class = {};  ///< of class_...

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

/// Whether changes of this kind are of a class, not of an object.
[[nodiscard]] inline bool isOfClass(CatalogueChange::Kind kind) {
  using Kind = CatalogueChange::Kind;
  return kind == Kind::class_added || kind == Kind::class_edited || kind == Kind::class_hidden ||
         kind == Kind::class_restored || kind == Kind::class_merged || kind == Kind::class_unmerged;
}

/// Changes in the order in which the database committed them.
struct CatalogueChanges {
  std::vector<CatalogueChange> changes;
  std::int64_t last_event = 0;  ///< where the next query continues
};

}  // namespace scantrove
