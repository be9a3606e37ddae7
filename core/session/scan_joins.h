#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/collection/collected_objects.h"
#include "core/editing/region_editor.h"
#include "core/session/saved_scan.h"
#include "core/session/session_joining.h"

namespace scantrove {

/// The effect of users' joins in a running scan on objects, so that a later run of the program can undo
/// them; stored as by opened sessions. Objects have the scan's keys until they are stored.
class ScanJoins {
 public:
  /// Call before the objects follow the events of that operation (OperationLog::Entry::number).
  void add(int operation, const RegionEvents& events, const CollectedObjects& objects);
  /// The objects before the join, by key, and the merges that an earlier scan made for it.
  struct Undone {
    std::map<RegionId, ObjectId> objects;
    std::vector<ObjectMerge> earlier;
  };
  /// The operation was undone in this scan.
  Undone remove(int operation);
  /// Joins of an earlier scan of the session.
  void restore(const SessionMetadata& metadata, const CollectedObjects& objects);
  /// Merges that the catalogue stored.
  void addMerges(std::span<const ObjectMerge> merges);
  /// The session's metadata of joins that changed since the last call.
  [[nodiscard]] SessionMetadata takeChanged(const CollectedObjects& objects);

 private:
  std::map<int, JoinedObjects> joins_;               // objects by key
  std::map<int, std::vector<ObjectMerge>> earlier_;  // of restored joins
  std::vector<ObjectMerge> merges_;                  // since the first join, in order
  SessionMetadata taken_;
};

}  // namespace scantrove
