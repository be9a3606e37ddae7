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

/// The effect of one operation that joined regions on their objects, as the session stores it.
struct JoinedObjects {
  enum class State { to_merge, done, to_unmerge };
  State state = State::done;
  std::string token = {};                            // tells the catalogue whether it has done it
  std::map<RegionId, ObjectId> before;               // of the joined regions; none: no object
  std::vector<std::pair<ObjectId, ObjectId>> pairs;  // to be merged
  std::vector<ObjectMerge> merges;                   // done in the catalogue
};

/// The metadata key for the joins of the operation with that number.
[[nodiscard]] std::string joinKeyOf(int operation);
[[nodiscard]] std::string joinedToText(const JoinedObjects& joined);
/// Empty for malformed text.
[[nodiscard]] JoinedObjects joinedFrom(const std::string& text);

/// Number of the operation that was done or undone last; 0: none.
[[nodiscard]] int lastOperation(const OperationLog& log, bool is_undone);

/// Joined regions take the object of any of them; returns the merges to do in the catalogue. Updates
/// `objects`.
[[nodiscard]] JoinedObjects joinObjects(const RegionEvents& events, std::map<RegionId, ObjectId>& objects);

/// Whether joins or undone joins are still pending in the catalogue.
[[nodiscard]] bool areJoinsPending(const OpenSession& session);

/// Executes them, each operation once: two objects are merged, also if users settled both, because users
/// joined their regions. CatalogueModel::merge() says which one remains. The session's thread. Error: the
/// catalogue failed, and the next call tries again.
[[nodiscard]] Result<void> mergeJoinedObjects(OpenSession& session, ObjectDatabase& database);

}  // namespace scantrove
