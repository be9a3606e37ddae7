#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalog/object_record.h"

namespace scantrove {

/// The catalogue on disk: SQLite (WAL) through QtSql. Tables objects, views, sessions, events; schema versioned by
/// numbered migrations. One instance belongs to one thread; several instances (window, worker, command line) may have
/// one file open. Every call is one transaction: after kill -9 the file holds all that returned. Every change by a
/// person or the scan is one row of `events`. Errors name the file.
class ObjectDatabase {
 public:
  /// Opens or creates the file (and applies missing migrations). `postgresql://...` is refused with a clear message.
  [[nodiscard]] static Result<std::unique_ptr<ObjectDatabase>> open(const std::string& database);
  ~ObjectDatabase();
  ObjectDatabase(const ObjectDatabase&) = delete;
  ObjectDatabase& operator=(const ObjectDatabase&) = delete;

  [[nodiscard]] Result<std::int64_t> beginSession(const std::string& source);
  Result<void> endSession(std::int64_t session);

  [[nodiscard]] Result<std::vector<ObjectRecord>> objects();
  [[nodiscard]] Result<ObjectRecord> object(ObjectId id);
  /// Id of the object called `name`, or none (value 0).
  [[nodiscard]] Result<ObjectId> findByName(const std::string& name);
  [[nodiscard]] Result<std::vector<ObjectView>> views(ObjectId id);
  /// The newest view's crop only, for lists. Empty image when there is none.
  [[nodiscard]] Result<ObjectView> representativeView(ObjectId id);
  /// All views of all objects with id > `after`, oldest first: how a detector catches up.
  [[nodiscard]] Result<std::vector<ObjectView>> viewsAfter(std::int64_t after);

  /// Adds an object named by the next free Obj_N with its first view, in one transaction.
  [[nodiscard]] Result<ObjectRecord> addObject(const Eigen::Vector3f& size_m, const ObjectView& first_view);
  [[nodiscard]] Result<std::int64_t> addView(const ObjectView& view);

  /// Error when another object has that name, or the name is empty.
  Result<void> rename(ObjectId id, const std::string& name);
  Result<void> setConfirmed(ObjectId id, bool confirmed);
  /// Moves the views of `from` to `into` and hides `from`. Undo with unmerge.
  Result<void> merge(ObjectId into, ObjectId from);
  Result<void> unmerge(ObjectId into, ObjectId from);
  /// Hides the object everywhere; restore brings it back.
  Result<void> remove(ObjectId id);
  Result<void> restore(ObjectId id);

 private:
  ObjectDatabase() = default;
  class Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace scantrove
