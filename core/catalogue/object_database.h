#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/catalogue_model.h"
#include "core/catalogue/catalogue_sessions.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/view_store.h"

namespace scantrove {

class DatabaseConnection;

/// The catalogue on disk: SQLite (WAL) through QtSql; schema versioned by numbered migrations (schema/*.sql
/// describe the tables). One instance belongs to one thread; several instances (window, worker, command line)
/// may have one file open; a call waits at most 5 s for another's. Every call that changes something is one
/// transaction: after kill -9 the file holds all that returned. CatalogueModel has the rules and the errors
/// of operations on objects; here their changes are stored, each with one row of `events`, which the others
/// read (changesAfter). Errors name the file. Nothing is ever deleted: asking for a hidden object by id is an
/// error that says what became of it.
///
/// Nothing but SQLite may open the file while it is in use: that another descriptor of the same process is
/// closed drops SQLite's POSIX locks, and the next program that closes the catalogue deletes its journal.
class ObjectDatabase {
 public:
  /// Whether something may still be done; a failure leaves the catalogue as it was.
  using Check = std::function<Result<void>()>;
  static Result<void> nothingToCheck() { return {}; }

  /// Opens or creates the file (and applies missing migrations). Error: a folder, no such parent folder, not
  /// writable, not a database, another program's, damaged, locked, newer.
  [[nodiscard]] static Result<std::unique_ptr<ObjectDatabase>> open(const std::string& database);
  /// Opens a catalogue that is there to read it: nothing in it or beside it is changed. What changes
  /// something is an error. Error: there is none, it is no catalogue, or one of another version.
  [[nodiscard]] static Result<std::unique_ptr<ObjectDatabase>> openToRead(const std::string& database);
  /// Tells this catalogue from all others: a UUID that was drawn when it was created, or brought up to date
  /// by this version. Copies of the file share it. Empty: it is of an older version and was opened to read.
  [[nodiscard]] Result<std::string> identity();
  /// Of one opened to read: what was read so far belongs together (DatabaseConnection::isStill).
  [[nodiscard]] bool isStill() const;
  ~ObjectDatabase();
  ObjectDatabase(const ObjectDatabase&) = delete;
  ObjectDatabase& operator=(const ObjectDatabase&) = delete;

  [[nodiscard]] CatalogueSessions& sessions() { return sessions_; }
  [[nodiscard]] ViewStore& views() { return views_; }

  [[nodiscard]] Result<std::vector<ObjectRecord>> objects();
  [[nodiscard]] Result<ObjectRecord> object(ObjectId id);
  /// Id of the visible object called `name`, or none (value 0).
  [[nodiscard]] Result<ObjectId> findByName(const std::string& name);
  /// CatalogueModel::mergeRoot(). Error: there never was such an object.
  [[nodiscard]] Result<ObjectId> mergeRoot(ObjectId id);
  /// The states of all objects, hidden ones too.
  [[nodiscard]] Result<CatalogueModel> model();

  /// The newest row of `events`, 0 when there is none: where changesAfter goes on.
  [[nodiscard]] Result<std::int64_t> lastEvent();
  /// What happened after that event, by this or any other program. Cheap when that is little or nothing.
  /// Sizes and best views are not in it: read the record.
  [[nodiscard]] Result<CatalogueChanges> changesAfter(std::int64_t event);

  /// Adds an object of the view's size, named by the next free Obj_N, with its first view. A number is given
  /// once, even when its object is renamed or hidden. `first_view.object` is ignored.
  [[nodiscard]] Result<ObjectRecord> addObject(const ObjectView& first_view);
  /// A view of an object that was merged goes to its merge root, and comes back with unmerge. Error: no such
  /// object; images that do not belong together; what `check` says. `check` is asked while nobody else can
  /// change anything any more, and only reads.
  [[nodiscard]] Result<std::int64_t> addView(const ObjectView& view, const Check& check = nothingToCheck);
  /// Views that `object` was given by that session, from those frames, show something else: they become an
  /// object of their own, which is removed. Where they are all that there is of it, it is removed itself.
  /// Nothing is done to what is settled or hidden. Whether it was removed.
  [[nodiscard]] Result<bool> discardViews(ObjectId object, std::int64_t session, std::span<const int> frames);

  // As CatalogueModel does it.
  Result<void> rename(ObjectId id, const std::string& name, NamedBy by = NamedBy::person);
  Result<void> setConfirmed(std::span<const ObjectId> objects, bool confirmed);
  [[nodiscard]] Result<ObjectNaming> nameByUser(ObjectId id, const std::string& name);
  [[nodiscard]] Result<bool> revertNaming(const ObjectNaming& naming);
  /// `check` as of addView.
  [[nodiscard]] Result<ObjectMerge> merge(std::span<const ObjectId> objects,
                                          const Check& check = nothingToCheck);
  Result<void> unmerge(const ObjectMerge& merge);
  Result<void> remove(std::span<const ObjectId> objects);
  Result<void> restore(std::span<const ObjectId> objects);
  [[nodiscard]] Result<bool> withdraw(ObjectId made);

  /// All that `edit` does here is one transaction, carried out once for each `token`: returns its text, now
  /// or as it was when that token came first. Error: as of `edit`, whose part is undone; the same token may
  /// be tried again.
  [[nodiscard]] Result<std::string> applyOnce(const std::string& token,
                                              const std::function<Result<std::string>()>& edit);

 private:
  /// `version`: of the schema.
  ObjectDatabase(std::unique_ptr<DatabaseConnection> connection, int version);

  std::unique_ptr<DatabaseConnection> connection_;
  CatalogueSessions sessions_;
  ViewStore views_;
  bool has_identity_;
};

}  // namespace scantrove
