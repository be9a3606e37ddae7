#pragma once
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_event.h"
#include "core/catalogue/catalogue_feed.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

/// What a scan stores in the catalogue. Objects have the scan's keys or the database's ids.
namespace job {
struct BeginSession {};
struct AddObject {
  ObjectView view;  ///< `view.object` is the key
};
struct AddView {
  ObjectView view;
};
struct Merge {
  ObjectId a, b;
  int join = 0;  ///< a user's join of their regions; 0: the scan found that they are one
};
struct Part {
  int join = 0;
  std::vector<ObjectMerge> earlier;  ///< its merges, if an earlier scan made them
};
struct Name {
  int naming = 0;
  ObjectId object;
  GivenName given;
  int again = 0;
};
struct RevertNaming {
  int naming = 0;
  std::optional<ObjectNaming> earlier;
};
struct Withdraw {
  ObjectId object;
};
struct DiscardViews {
  ObjectId object;
  std::vector<int> frames;
};
struct EndSession {};
}  // namespace job

using CatalogueJob =
    std::variant<job::BeginSession, job::AddObject, job::AddView, job::Merge, job::Part, job::Name,
                 job::RevertNaming, job::Withdraw, job::DiscardViews, job::EndSession>;

/// Executes a scan's jobs in the catalogue over its own connection: the database part of CatalogueWriter.
/// One thread, the writer's, from open() to close().
class CatalogueJobs {
 public:
  using Events = std::vector<CatalogueEvent>;

  struct Options {
    std::string database = {};              ///< as ObjectDatabase::open takes it
    std::string source = {};                ///< source of a new session
    std::optional<Intrinsics> camera = {};  ///< the depth camera, if known
    std::int64_t session = 0;               ///< the session to continue; 0: a new one begins
    std::map<ObjectId, ObjectId> ids = {};  ///< of the objects that the session added, by key
  };
  /// `notify` receives events that occur during a job.
  CatalogueJobs(Options options, std::function<void(Events)> notify)
      : options_(std::move(options)), notify_(std::move(notify)), ids_(options_.ids) {}

  /// Reads edits from `from` on. Error: the catalogue cannot be opened.
  [[nodiscard]] Result<void> open(CataloguePosition from);
  void close();

  struct Outcome {
    Events events;
    std::optional<Error> refusal;  ///< the job can never be done, and is given up
  };
  /// Executes one job. Error: the catalogue failed, and the job must be tried again.
  [[nodiscard]] Result<Outcome> attempt(CatalogueJob& job);
  /// Whether a failed attempt may have stored its row. Reading changes now would take the row for another's.
  [[nodiscard]] bool isInDoubt() const { return !token_.empty(); }
  /// Changes by others since the last call.
  [[nodiscard]] Result<CatalogueEdits> readEdits() { return feed_->readEdits(); }

  /// The session, and the newest event that was read when the catalogue was closed.
  [[nodiscard]] std::int64_t session() const { return session_; }
  [[nodiscard]] std::int64_t lastEvent() const { return last_event_; }

 private:
  /// The report for a job that is given up.
  [[nodiscard]] Events refuse(const CatalogueJob& job, const Error& error);
  [[nodiscard]] Result<Events> execute(const job::BeginSession& job);
  [[nodiscard]] Result<Events> execute(job::AddObject& job);
  [[nodiscard]] Result<Events> execute(job::AddView& job);
  [[nodiscard]] Result<Events> execute(const job::Merge& job);
  [[nodiscard]] Result<Events> execute(const job::Part& job);
  [[nodiscard]] Result<Events> execute(const job::Name& job);
  [[nodiscard]] Result<Events> execute(const job::RevertNaming& job);
  [[nodiscard]] Result<Events> execute(const job::Withdraw& job);
  [[nodiscard]] Result<Events> execute(const job::DiscardViews& job);
  [[nodiscard]] Result<Events> execute(const job::EndSession& job);
  /// Appends the objects' current records to `event`. Unreadable ones keep their last known state.
  [[nodiscard]] Events withRecords(CatalogueEvent event, std::span<const ObjectId> objects);
  [[nodiscard]] ObjectId idOf(ObjectId object) const;
  /// Runs `store`, which returns the id of a new row. If a server was lost while it committed, the next
  /// attempt of the same job returns the id of that row instead of storing a second one.
  [[nodiscard]] Result<std::int64_t> storeOnce(const std::function<Result<std::int64_t>()>& store);
  /// The current merge roots of the two objects: fewer than two if they are merged or deleted.
  [[nodiscard]] Result<std::vector<ObjectId>> mergeRootsOf(const job::Merge& job);
  [[nodiscard]] Result<bool> mayMerge(const std::vector<ObjectId>& pair);
  [[nodiscard]] std::optional<std::pair<dev_t, ino_t>> fileNow() const;
  /// Error: the open file was moved or removed, which SQLite does not detect.
  [[nodiscard]] Result<void> checkFile() const;

  const Options options_;
  const std::function<void(Events)> notify_;
  std::unique_ptr<ObjectDatabase> database_;
  std::optional<CatalogueFeed> feed_;
  std::string token_;  // of the job in progress; empty: none is needed yet
  std::int64_t session_ = 0;
  std::int64_t last_event_ = 0;
  std::map<ObjectId, ObjectId> ids_;                // of this scan's objects, by key; none: refused
  std::set<ObjectId> touched_;                      // objects that this scan changed
  std::map<int, ObjectNaming> namings_;             // by their numbers
  std::map<int, std::vector<ObjectMerge>> joined_;  // merges of users' joins, by their numbers
  std::set<int> overruled_;                      // could not be reverted, because others changed them since
  std::optional<std::pair<dev_t, ino_t>> file_;  // none: the catalogue is not a file
};

}  // namespace scantrove
