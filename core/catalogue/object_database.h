#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/catalogue_classes.h"
#include "core/catalogue/catalogue_model.h"
#include "core/catalogue/catalogue_sessions.h"
#include "core/catalogue/different_objects.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/view_store.h"

namespace scantrove {

class DatabaseConnection;

/// The catalogue on disk: SQLite (WAL) or PostgreSQL through QtSql, with a schema versioned by numbered
/// migrations (schema/*.sql describe the tables). One instance belongs to one thread. Several instances
/// (window, worker, command line) may open one file; a call waits at most 5 s for another's. Each change is
/// one transaction: after kill -9 the file holds every call that returned. CatalogueModel defines operations
/// on objects and their errors. Each change is stored with one row of `events`, which other instances read
/// (changesAfter). Errors name the file. Nothing is ever deleted: the id of a hidden object gives an error
/// that says what happened to it. It has more than thirty functions, because each operation of CatalogueModel
/// is also a transaction here.
///
/// On a server a call may fail because the connection is lost. Later calls make it again; only a call that is
/// lost while it commits may have been carried out.
///
/// Only SQLite may open the file while it is in use. Closing another descriptor in the same process drops
/// SQLite's POSIX locks, and the next program that closes the catalogue deletes its journal.
class ObjectDatabase {
 public:
  /// Whether an operation may proceed; a failure leaves the catalogue unchanged.
  using Check = std::function<Result<void>()>;
  static Result<void> nothingToCheck() { return {}; }

  /// Opens or creates the file, or opens the server's database (isServerAddress), and applies missing
  /// migrations. Error: a folder, missing parent folder, not writable, not a database, another program's,
  /// damaged, locked, newer; as DatabaseConnection::open.
  [[nodiscard]] static Result<std::unique_ptr<ObjectDatabase>> open(const std::string& database);
  /// Opens an existing catalogue for reading; nothing in it or beside it changes, and changing calls fail.
  /// Error: missing, no catalogue, or another version.
  [[nodiscard]] static Result<std::unique_ptr<ObjectDatabase>> openToRead(const std::string& database);
  /// Whether it lies in a database of a PostgreSQL server.
  [[nodiscard]] bool isOnServer() const;
  /// Identifies this catalogue: a UUID, drawn when it was created or migrated to this version. Copies of
  /// the file share it. Empty: an older version opened for reading.
  [[nodiscard]] Result<std::string> identity();
  /// For one opened for reading: whether all reads so far are consistent (DatabaseConnection::isStill).
  [[nodiscard]] bool isStill() const;
  ~ObjectDatabase();
  ObjectDatabase(const ObjectDatabase&) = delete;
  ObjectDatabase& operator=(const ObjectDatabase&) = delete;

  [[nodiscard]] CatalogueSessions& sessions() { return sessions_; }
  [[nodiscard]] ViewStore& views() { return views_; }
  [[nodiscard]] CatalogueClasses& classes() { return classes_; }
  [[nodiscard]] DifferentObjects& differences() { return differences_; }

  [[nodiscard]] Result<std::vector<ObjectRecord>> objects();
  [[nodiscard]] Result<ObjectRecord> object(ObjectId id);
  /// Id of the visible object called `name`, or none (value 0).
  [[nodiscard]] Result<ObjectId> findByName(const std::string& name);
  /// CatalogueModel::mergeRoot(). Error: there never was such an object.
  [[nodiscard]] Result<ObjectId> mergeRoot(ObjectId id);
  /// The states of all objects and classes, including hidden ones.
  [[nodiscard]] Result<CatalogueModel> model();

  /// The newest row of `events`, where changesAfter continues; 0: none.
  [[nodiscard]] Result<std::int64_t> lastEvent();
  /// Changes after that event, by any program. Fast if there are few. Sizes and best views are not
  /// included: read the record.
  [[nodiscard]] Result<CatalogueChanges> changesAfter(std::int64_t event);

  /// Adds an object of the view's size with its first view, named by the next free Obj_N. Numbers are never
  /// reused, even after renaming or hiding. `first_view.object` is ignored.
  [[nodiscard]] Result<ObjectRecord> addObject(const ObjectView& first_view);
  /// A view of a merged object goes to its merge root, and back with unmerge. Error: no such object; images
  /// that do not match each other; the error of `check`. `check` runs while nobody else can write, and only
  /// reads.
  [[nodiscard]] Result<std::int64_t> addView(const ObjectView& view, const Check& check = nothingToCheck);
  /// Removes views that `object` got in that session: for each of `frames` the oldest one from there. They
  /// become a new hidden object, which uses up no Obj_N. An object without other views is removed itself.
  /// Nothing changes unless CatalogueModel::mayDiscardViews(). Returns whether the object was removed.
  [[nodiscard]] Result<bool> discardViews(ObjectId object, std::int64_t session, std::span<const int> frames);

  // Operations of CatalogueModel.
  Result<void> rename(ObjectId id, const std::string& name, NamedBy by = NamedBy::user);
  Result<void> setConfirmed(std::span<const ObjectId> objects, bool confirmed);
  [[nodiscard]] Result<ObjectNaming> nameByUser(ObjectId id, const std::string& name,
                                                const std::string& class_name = {});
  [[nodiscard]] Result<bool> revertNaming(const ObjectNaming& naming);
  /// `check` as in addView.
  [[nodiscard]] Result<ObjectMerge> merge(std::span<const ObjectId> objects,
                                          const Check& check = nothingToCheck);
  Result<void> unmerge(const ObjectMerge& merge);
  /// The same, unless others have separated or deleted the objects since. Returns whether they were merged.
  [[nodiscard]] Result<bool> revertMerge(const ObjectMerge& merge);
  Result<void> remove(std::span<const ObjectId> objects);
  Result<void> restore(std::span<const ObjectId> objects);
  [[nodiscard]] Result<bool> withdraw(ObjectId made);

  /// Runs `edit` as one transaction, once for each `token`. Returns its text, now or from the first call
  /// with that token. Error: of `edit`, which is rolled back; the same token may be tried again.
  [[nodiscard]] Result<std::string> applyOnce(const std::string& token,
                                              const std::function<Result<std::string>()>& edit);

 private:
  /// `version`: of the schema.
  ObjectDatabase(std::unique_ptr<DatabaseConnection> connection, int version);

  std::unique_ptr<DatabaseConnection> connection_;
  CatalogueSessions sessions_;
  ViewStore views_;
  CatalogueClasses classes_;
  DifferentObjects differences_;
  bool has_identity_;
  bool has_classes_;
};

}  // namespace scantrove
