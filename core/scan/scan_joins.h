#pragma once
#include <map>
#include <span>
#include <string>

#include "core/collection/collected_objects.h"
#include "core/editing/region_editor.h"
#include "core/session/saved_scan.h"
#include "core/session/session_joining.h"

namespace scantrove {

/// What joins by users in a running scan did to objects, so that a later run of the program can undo them: as
/// opened sessions keep it of theirs. Objects are followed by the scan's keys until they are stored.
class ScanJoins {
 public:
  /// Before the objects follow the events of that operation (OperationLog::Entry::number).
  void add(int operation, const RegionEvents& events, const CollectedObjects& objects);
  /// It was undone in this scan.
  void remove(int operation);
  /// What the catalogue stored.
  void addMerges(std::span<const ObjectMerge> merges);
  /// The session's metadata of joins, as far as it changed since the last call.
  [[nodiscard]] SessionMetadata takeChanged(const CollectedObjects& objects);

 private:
  std::map<int, JoinedObjects> joins_;  // objects by key
  std::vector<ObjectMerge> merges_;     // since the first join, in order
  SessionMetadata taken_;
};

}  // namespace scantrove
