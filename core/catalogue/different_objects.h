#pragma once
#include <set>

#include "core/base/result.h"
#include "core/catalogue/alike_objects.h"

namespace scantrove {

class DatabaseConnection;

/// Pairs of objects that a user called different things, which are not suggested for merging any more. They
/// are rows of `events`, which other versions skip; merging such a pair by hand stays possible.
class DifferentObjects {
 public:
  explicit DifferentObjects(DatabaseConnection& connection) : connection_(connection) {}

  /// By the ids that they had then.
  [[nodiscard]] Result<std::set<ObjectPair>> pairs();
  /// `are_different` false: takes it back.
  [[nodiscard]] Result<void> record(ObjectId a, ObjectId b, bool are_different);

 private:
  DatabaseConnection& connection_;
};

}  // namespace scantrove
