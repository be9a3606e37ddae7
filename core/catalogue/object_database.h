#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

class DatabaseConnection;

/// The catalogue on disk: SQLite (WAL) through QtSql; schema versioned by numbered migrations (schema/*.sql
/// describe the tables). One instance belongs to one thread; several instances (window, worker, command line)
/// may have one file open; a call waits at most 5 s for another's. Every call that changes something is one
/// transaction: after kill -9 the file holds all that returned. Every change is one row of `events`, which
/// the others read (changesAfter). Errors name the file. Nothing is ever deleted: removed and merged objects
/// are hidden, and asking for one by id is an error that says so.
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
  /// Whether a scan began in this catalogue within ten minutes of `begun` (ISO 8601, UTC).
  [[nodiscard]] Result<bool> hasScanOf(const std::string& begun);
  /// Of one opened to read: what was read so far belongs together (DatabaseConnection::isStill).
  [[nodiscard]] bool isStill() const;
  ~ObjectDatabase();
  ObjectDatabase(const ObjectDatabase&) = delete;
  ObjectDatabase& operator=(const ObjectDatabase&) = delete;

  /// `camera`: of the depth images that its views were cut from, where it is known.
  [[nodiscard]] Result<std::int64_t> beginSession(const std::string& source,
                                                  const std::optional<Intrinsics>& camera = std::nullopt);
  Result<void> endSession(std::int64_t session);
  /// The depth camera of each session of which it is known.
  [[nodiscard]] Result<std::map<std::int64_t, Intrinsics>> cameras();

  [[nodiscard]] Result<std::vector<ObjectRecord>> objects();
  [[nodiscard]] Result<ObjectRecord> object(ObjectId id);
  /// Id of the visible object called `name`, or none (value 0).
  [[nodiscard]] Result<ObjectId> findByName(const std::string& name);
  /// The object that holds what was `id`'s, after merges; none when it was deleted.
  [[nodiscard]] Result<ObjectId> resolve(ObjectId id);
  /// The same for all objects that ever were, by id.
  [[nodiscard]] Result<std::vector<MergeRoot>> mergeRoots();

  /// With their images, oldest first; a view whose images cannot be used is left out and named in the log.
  [[nodiscard]] Result<std::vector<ObjectView>> views(ObjectId id);
  /// A small picture of the object's best view, CV_8UC3 BGR, for lists (see listPicture). Empty when it has
  /// no colour.
  [[nodiscard]] Result<cv::Mat> picture(ObjectId id);
  /// Such pictures of all its views, newest first.
  [[nodiscard]] Result<std::vector<cv::Mat>> pictures(ObjectId id);
  /// Visits the descriptors of all views with id > `after`, of hidden objects too, by ascending id, one at a
  /// time; returns the last id. Views of an older version are described first, once (about 1 ms a view). A
  /// damaged row is left out and named in the log.
  [[nodiscard]] Result<std::int64_t> forEachDescriptor(
      std::int64_t after, const std::function<void(const StoredDescriptor&)>& visit);

  /// How many views there are, of hidden objects too.
  [[nodiscard]] Result<int> viewCount();

  /// The newest row of `events`, 0 when there is none: where changesAfter goes on.
  [[nodiscard]] Result<std::int64_t> lastEvent();
  /// What happened after that event, by this or any other program. Cheap when that is little or nothing.
  /// Sizes, best views and the name that a restored object comes back with are not in it: read the record.
  [[nodiscard]] Result<CatalogueChanges> changesAfter(std::int64_t event);

  /// Adds an object of the view's size, named by the next free Obj_N, with its first view. A number is given
  /// once, even when its object is renamed or hidden. `first_view.object` is ignored.
  [[nodiscard]] Result<ObjectRecord> addObject(const ObjectView& first_view);
  /// A view of an object that was merged goes to the one that holds it now, and comes back with unmerge.
  /// Error: no such object; images that do not belong together; what `check` says. `check` is asked while
  /// nobody else can change anything any more, and only reads.
  [[nodiscard]] Result<std::int64_t> addView(const ObjectView& view, const Check& check = nothingToCheck);

  /// Views that `object` was given by that session, from those frames, show something else: they become an
  /// object of their own, which is removed. Where they are all that there is of it, it is removed itself.
  /// Nothing is done to what a person named or confirmed, nor to what is hidden. Whether it was removed.
  [[nodiscard]] Result<bool> discardViews(ObjectId object, std::int64_t session, std::span<const int> frames);

  /// Blanks around the name are dropped. Error: no name for an object (see checkedObjectName), or another
  /// visible object has it. `by` is `program` only to take a person's name back.
  Result<void> rename(ObjectId id, const std::string& name, NamedBy by = NamedBy::person);
  Result<void> setConfirmed(std::span<const ObjectId> objects, bool confirmed);
  /// The name as it would be stored. Error: it is none for an object (see checkedObjectName).
  [[nodiscard]] static Result<std::string> checkedName(const std::string& name);
  /// A person says what an object is (or who holds it by now): it gets the name and is confirmed. Where
  /// another visible object has that name already, it becomes part of that one, unless a person said what it
  /// is, too: then nothing is done. Error: no name for an object; it was deleted.
  [[nodiscard]] Result<ObjectNaming> nameByPerson(ObjectId id, const std::string& name);
  /// The object is what it was before, but for what persons said since. False: that was all of it.
  [[nodiscard]] Result<bool> takeNameBack(const ObjectNaming& naming);
  /// Makes one object of two or more. The one that a person named holds the others' views; then the confirmed
  /// one, then the older one: numbers stay what they were. It is confirmed when any of them was. `check` as
  /// of addView.
  [[nodiscard]] Result<ObjectMerge> merge(std::span<const ObjectId> objects,
                                          const Check& check = nothingToCheck);
  /// Takes a merge back: each has its own views, size and mark again, and its name, or "name (2)" where the
  /// name was given away meanwhile (the same holds for restore). Views that came after the merge go to whom
  /// they were stored for.
  Result<void> unmerge(const ObjectMerge& merge);
  /// All that `edit` does here is one transaction, carried out once for each `token`: returns its text, now
  /// or as it was when that token came first. Error: as of `edit`, whose part is undone; the same token may
  /// be tried again.
  [[nodiscard]] Result<std::string> applyOnce(const std::string& token,
                                              const std::function<Result<std::string>()>& edit);
  /// Hides objects everywhere; restore brings them back.
  Result<void> remove(std::span<const ObjectId> objects);
  Result<void> restore(std::span<const ObjectId> objects);
  /// Removes an object that was made for something which a person took back; not one that a person named,
  /// confirmed or made others part of, nor one that is hidden already. Whether it was removed.
  [[nodiscard]] Result<bool> withdraw(ObjectId made);

 private:
  ObjectDatabase();
  // Inside the caller's transaction:
  [[nodiscard]] Result<std::int64_t> insertView(ObjectView view);
  [[nodiscard]] Result<ObjectMerge> mergeRows(std::span<const ObjectId> objects);
  [[nodiscard]] Result<void> unmergeRows(const ObjectMerge& merge);
  std::unique_ptr<DatabaseConnection> connection_;
  bool has_cameras_ = true;  // its sessions may have
  bool has_identity_ = true;
};

}  // namespace scantrove
