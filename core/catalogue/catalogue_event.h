#pragma once
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// How far the catalogue was read.
struct CataloguePosition {
  std::int64_t event = 0;  ///< newest row of `events`
  std::int64_t view = 0;   ///< newest view whose descriptor was read
};

/// What users and other programs did to the catalogue, and how it is now.
struct CatalogueEdits {
  std::vector<CatalogueChange> changes;
  std::vector<ObjectState> objects;     ///< of all objects; empty: as before, but for `changes`
  std::vector<ObjectRecord> records;    ///< of visible objects that changed
  std::vector<StoredDescriptor> views;  ///< that are new

  [[nodiscard]] bool isEmpty() const { return changes.empty() && objects.empty() && records.empty(); }
};

/// What the catalogue's thread reports to the scan. `key`: the id by which the scan asked for it; all others
/// are those of the database.
namespace event {
struct ObjectStored {
  ObjectId key;
  ObjectRecord record;
};
/// It never will be; why is part of what CatalogueWriter::finish says.
struct ObjectRefused {
  ObjectId key;
};
struct ViewStored {
  ObjectId key;
  ObjectId root;
};
/// Its object was deleted meanwhile, or it cannot be stored.
struct ViewDropped {
  ObjectId key;
};
struct MergeStored {
  ObjectMerge merge;
  std::optional<ObjectRecord> root;  ///< none: hidden by now
};
/// Persons settled both objects meanwhile, or one of them is gone. Edits that say how it is follow.
struct MergeDropped {};
/// A person's name for an object is stored. Edits that say how it is follow.
struct NameStored {
  ObjectId key;
  int number = 0;  ///< by which the scan knows the naming
  ObjectNaming naming;
};
/// The object was deleted meanwhile, or another one is called so. Edits that say how it is follow.
struct NameDropped {
  ObjectId key;
  std::optional<Error> why;  ///< none: it was deleted
};
/// A person's name was taken back, as far as nobody has said otherwise since. Edits follow.
struct NameTakenBack {
  ObjectId object;
};
/// Views of it showed something else in the end, and are not of it any more. Edits follow.
struct ViewsDiscarded {
  ObjectId object;
  bool is_removed = false;  ///< they were all that there was
};
struct Edited {
  CatalogueEdits edits;
};
/// The catalogue cannot be read or written for now. Said once until all works again.
struct Failed {
  Error error;
};
}  // namespace event

using CatalogueEvent =
    std::variant<event::ObjectStored, event::ObjectRefused, event::ViewStored, event::ViewDropped,
                 event::MergeStored, event::MergeDropped, event::NameStored, event::NameDropped,
                 event::NameTakenBack, event::ViewsDiscarded, event::Edited, event::Failed>;

}  // namespace scantrove
