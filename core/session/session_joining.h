#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"
#include "core/editing/region_editor.h"

namespace scantrove {

class ObjectDatabase;
class OpenSession;

/// What one operation that joined regions did to their objects, as the session keeps it.
struct JoinedObjects {
  enum class State { to_merge, done, to_unmerge };
  State state = State::done;
  std::string token = {};                            // by which the catalogue knows whether it did it
  std::map<RegionId, ObjectId> before;               // of the joined regions; none: it was no object
  std::vector<std::pair<ObjectId, ObjectId>> pairs;  // that are to be one
  std::vector<ObjectMerge> merges;                   // done in the catalogue
};

/// The session's fact that keeps those of the operation with that number.
[[nodiscard]] std::string joinKeyOf(int operation);
[[nodiscard]] std::string joinedToText(const JoinedObjects& joined);
/// An empty one for what was not written so.
[[nodiscard]] JoinedObjects joinedFrom(const std::string& text);

/// Number of the operation that was done, or undone, last; 0: none.
[[nodiscard]] int lastOperation(const OperationLog& log, bool is_undone);

/// Joined regions are what any of them was; what to merge in the catalogue for that. `objects` follow.
[[nodiscard]] JoinedObjects joinObjects(const RegionEvents& events, std::map<RegionId, ObjectId>& objects);

/// Whether joins, or undone joins, have something left to do in the catalogue.
[[nodiscard]] bool areJoinsPending(const OpenSession& session);

/// Does it, each operation once: two objects become one, as in a running scan, unless users settled both.
/// Thread of the session. Error: the catalogue failed, and the next call tries again; or users settled both.
[[nodiscard]] Result<void> mergeJoinedObjects(OpenSession& session, ObjectDatabase& database);

}  // namespace scantrove
