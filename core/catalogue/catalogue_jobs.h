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

/// What a scan has the catalogue store. Objects are named by the scan's keys or by the database's ids.
namespace job {
struct BeginSession {};
struct AddObject {
  ObjectView view;  ///< by the key `view.object`
};
struct AddView {
  ObjectView view;
};
struct Merge {
  ObjectId a, b;
};
struct Name {
  int naming = 0;
  ObjectId object;
  std::string name;
  int again = 0;
};
struct TakeNameBack {
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

using CatalogueJob = std::variant<job::BeginSession, job::AddObject, job::AddView, job::Merge, job::Name,
                                  job::TakeNameBack, job::Withdraw, job::DiscardViews, job::EndSession>;

/// Does the jobs of a scan in the catalogue, over a connection of its own: the part of CatalogueWriter that
/// knows the database. One thread, the writer's, from open() to close().
class CatalogueJobs {
 public:
  using Events = std::vector<CatalogueEvent>;

  struct Options {
    std::string database = {};              ///< as ObjectDatabase::open takes it
    std::string source = {};                ///< of the session that is begun
    std::optional<Intrinsics> camera = {};  ///< its depth camera, where it is known
    std::int64_t session = 0;               ///< one that continues; 0: one is begun
    std::map<ObjectId, ObjectId> ids = {};  ///< of the objects that it added, by key
  };
  /// `notify`: is given what comes up in the middle of a job.
  CatalogueJobs(Options options, std::function<void(Events)> notify)
      : options_(std::move(options)), notify_(std::move(notify)), ids_(options_.ids) {}

  /// Edits are read from `from` on. Error: the catalogue cannot be opened.
  [[nodiscard]] Result<void> open(CataloguePosition from);
  void close();

  struct Outcome {
    Events events;
    std::optional<Error> refusal;  ///< the job would never be done, and is given up
  };
  /// Does one job. Error: the catalogue failed, and the job is to be tried again.
  [[nodiscard]] Result<Outcome> attempt(CatalogueJob& job);
  /// What others did since the last call.
  [[nodiscard]] Result<CatalogueEdits> readEdits() { return feed_->follow(); }

  /// The session, and the newest event that was known of the catalogue when it was closed.
  [[nodiscard]] std::int64_t session() const { return session_; }
  [[nodiscard]] std::int64_t lastEvent() const { return last_event_; }

 private:
  /// What is reported of a job that is given up.
  [[nodiscard]] Events refuse(const CatalogueJob& job, const Error& error);
  [[nodiscard]] Result<Events> execute(const job::BeginSession& job);
  [[nodiscard]] Result<Events> execute(job::AddObject& job);
  [[nodiscard]] Result<Events> execute(job::AddView& job);
  [[nodiscard]] Result<Events> execute(const job::Merge& job);
  [[nodiscard]] Result<Events> execute(const job::Name& job);
  [[nodiscard]] Result<Events> execute(const job::TakeNameBack& job);
  [[nodiscard]] Result<Events> execute(const job::Withdraw& job);
  [[nodiscard]] Result<Events> execute(const job::DiscardViews& job);
  [[nodiscard]] Result<Events> execute(const job::EndSession& job);
  /// As they are now, behind `event`. What cannot be read now is as it was known.
  [[nodiscard]] Events withRecords(CatalogueEvent event, std::span<const ObjectId> objects);
  [[nodiscard]] ObjectId idOf(ObjectId object) const;
  /// Who holds the two objects of a merge now: two, or fewer when they are one or deleted.
  [[nodiscard]] Result<std::vector<ObjectId>> mergeRootsOf(const job::Merge& job);
  [[nodiscard]] Result<bool> mayMerge(const std::vector<ObjectId>& pair);
  [[nodiscard]] std::optional<std::pair<dev_t, ino_t>> fileNow() const;
  /// Error: the file that is written to is no longer where it was. SQLite does not see that.
  [[nodiscard]] Result<void> checkFile() const;

  const Options options_;
  const std::function<void(Events)> notify_;
  std::unique_ptr<ObjectDatabase> database_;
  std::optional<CatalogueFeed> feed_;
  std::int64_t session_ = 0;
  std::int64_t last_event_ = 0;
  std::map<ObjectId, ObjectId> ids_;             // of this scan's objects, by key; none: refused
  std::set<ObjectId> touched_;                   // objects that this scan gave something
  std::map<int, ObjectNaming> namings_;          // by the numbers that were given
  std::set<int> overruled_;                      // that could not be taken back: others had said otherwise
  std::optional<std::pair<dev_t, ino_t>> file_;  // none: the catalogue is no file
};

}  // namespace scantrove
