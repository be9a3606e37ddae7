#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalog/object_record.h"

namespace scantrove {

class DatabaseConnection;

/// The catalogue on disk: SQLite (WAL) through QtSql. Tables objects, views, sessions, events; schema
/// versioned by numbered migrations. One instance belongs to one thread; several instances (window, worker,
/// command line) may have one file open; a call waits at most 5 s for another's. Every call is one
/// transaction: after kill -9 the file holds all that returned. Every change by a person or the scan is one
/// row of `events`. Errors name the file. Nothing is ever deleted: removed and merged objects are hidden, and
/// asking for one by id is an error that says so.
class ObjectDatabase {
 public:
  /// Opens or creates the file (and applies missing migrations). `postgresql://...` is refused with a clear
  /// message. Error: a folder, no such parent folder, not writable, not a database, another program's,
  /// damaged, locked, newer.
  [[nodiscard]] static Result<std::unique_ptr<ObjectDatabase>> open(const std::string& database);
  ~ObjectDatabase();
  ObjectDatabase(const ObjectDatabase&) = delete;
  ObjectDatabase& operator=(const ObjectDatabase&) = delete;

  [[nodiscard]] Result<std::int64_t> beginSession(const std::string& source);
  Result<void> endSession(std::int64_t session);

  [[nodiscard]] Result<std::vector<ObjectRecord>> objects();
  [[nodiscard]] Result<ObjectRecord> object(ObjectId id);
  /// Id of the visible object called `name`, or none (value 0).
  [[nodiscard]] Result<ObjectId> findByName(const std::string& name);
  /// The object that holds what was `id`'s, after merges; none when it was deleted.
  [[nodiscard]] Result<ObjectId> resolve(ObjectId id);
  [[nodiscard]] Result<std::vector<ObjectView>> views(ObjectId id);
  /// The newest view's crop only, for lists. Empty image when there is none.
  [[nodiscard]] Result<ObjectView> representativeView(ObjectId id);
  /// All views with id > `after` of all visible objects, oldest first: how a detector catches up.
  [[nodiscard]] Result<std::vector<ObjectView>> viewsAfter(std::int64_t after);

  /// Adds an object named by the next free Obj_N with its first view, in one transaction. A number is given
  /// once, even when its object is renamed or hidden.
  [[nodiscard]] Result<ObjectRecord> addObject(const Eigen::Vector3f& size_m, const ObjectView& first_view);
  /// A view of an object that was merged goes to the one that holds it now, and comes back with unmerge.
  [[nodiscard]] Result<std::int64_t> addView(const ObjectView& view);

  /// Error when another visible object has that name, or the name is empty (blanks around it are dropped).
  Result<void> rename(ObjectId id, const std::string& name);
  Result<void> setConfirmed(ObjectId id, bool confirmed);
  /// Moves the views of `from` to `into` and hides `from`. Undo with unmerge: `from` has its own views again,
  /// and its name, or "name (2)" where the name was given away meanwhile; the same holds for restore.
  Result<void> merge(ObjectId into, ObjectId from);
  Result<void> unmerge(ObjectId into, ObjectId from);
  /// Hides the object everywhere; restore brings it back.
  Result<void> remove(ObjectId id);
  Result<void> restore(ObjectId id);

 private:
  ObjectDatabase();
  [[nodiscard]] Result<std::int64_t> insertView(const ObjectView& view);  // inside the caller's transaction
  std::unique_ptr<DatabaseConnection> connection_;
};

}  // namespace scantrove
