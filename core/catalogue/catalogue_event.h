#pragma once
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/class_table.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// How far the catalogue was read.
struct CataloguePosition {
  std::int64_t event = 0;  ///< newest row of `events`
  std::int64_t view = 0;   ///< newest view whose descriptor was read
};

/// Changes by users and other programs, and the resulting state.
struct CatalogueEdits {
  std::vector<CatalogueChange> changes;
  std::vector<ObjectState> objects;     ///< of all objects; empty: only `changes` apply
  ClassTable classes = {};              ///< all, beside `objects`
  std::vector<ObjectRecord> records;    ///< of visible objects that changed
  std::vector<StoredDescriptor> views;  ///< new ones

  [[nodiscard]] bool isEmpty() const { return changes.empty() && objects.empty() && records.empty(); }
};

/// Reports of the catalogue's thread to the scan. `key`: the id that the scan requested the object by. All
/// other ids are those of the database.
namespace event {
struct ObjectStored {
  ObjectId key;
  ObjectRecord record;
};
/// The job is given up; CatalogueWriter::finish reports why.
struct ObjectRefused {
  ObjectId key;
};
struct ViewStored {
  ObjectId key;
  ObjectId root;
};
/// The object was deleted meanwhile, or the view cannot be stored.
struct ViewDropped {
  ObjectId key;
};
struct MergeStored {
  ObjectMerge merge;
  std::optional<ObjectRecord> root;  ///< none: hidden by now
};
/// Users settled both objects meanwhile, or one of them is gone. Edits with the current state follow.
struct MergeDropped {};
/// A user's name for an object is stored. Edits with the current state follow.
struct NameStored {
  ObjectId key;
  int number = 0;  ///< the scan's number of the naming
  ObjectNaming naming;
};
/// The object was deleted meanwhile, or another has the name. Edits with the current state follow.
struct NameDropped {
  ObjectId key;
  std::optional<Error> why;  ///< none: it was deleted
};
/// A user's name was reverted, except for later changes by others. Edits follow.
struct NamingReverted {
  ObjectId object;
};
/// Views of the object showed something else and were removed from it. Edits follow.
struct ViewsDiscarded {
  ObjectId object;
  bool is_removed = false;  ///< the object had no other views
};
struct Edited {
  CatalogueEdits edits;
};
/// The catalogue cannot be read or written now. Reported once until it works again.
struct Failed {
  Error error;
};
}  // namespace event

using CatalogueEvent =
    std::variant<event::ObjectStored, event::ObjectRefused, event::ViewStored, event::ViewDropped,
                 event::MergeStored, event::MergeDropped, event::NameStored, event::NameDropped,
                 event::NamingReverted, event::ViewsDiscarded, event::Edited, event::Failed>;

}  // namespace scantrove
