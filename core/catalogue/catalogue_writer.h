#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_event.h"
#include "core/catalogue/catalogue_jobs.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

class ServerNotifications;

/// Stores a scan's results on its own thread and connection, so that SQL and image encoding do not delay
/// frames. Jobs are executed in order, so equal scans give equal catalogues. A job that fails because the
/// catalogue cannot be written now (locked, full disk) is repeated, and later jobs wait. Results come back
/// as events only after they are committed. All functions for the scan's thread; only settle() and finish()
/// wait for the database, and addObject() when too many bytes wait.
///
/// Objects that are not stored yet have the keys given to addObject(); jobs accept keys and database ids.
class CatalogueWriter {
 public:
  struct Options {
    std::string database = {};                      ///< as ObjectDatabase::open takes it
    std::string source = {};                        ///< source of a new session
    std::optional<Intrinsics> camera = {};          ///< its depth camera, if known
    std::int64_t session = 0;                       ///< the session to continue; 0: a new one begins
    std::map<ObjectId, ObjectId> ids = {};          ///< of the objects that the session added, by key
    std::function<void()> on_events = {};           ///< events can be drained; called on the writer's thread
    std::chrono::milliseconds retry{500};           ///< after a failure
    std::chrono::milliseconds patience{20000};      ///< of finish(), without progress
    std::chrono::milliseconds room_patience{5000};  ///< of addObject(), while there is no room
    std::size_t most_bytes = std::size_t{256} << 20U;  ///< of waiting images; half of it for further views
  };

  /// Opens the catalogue on the new thread; events start after `from`. The session begins with the first
  /// job. Error: it cannot be opened.
  [[nodiscard]] static Result<std::unique_ptr<CatalogueWriter>> start(const Options& options,
                                                                      CataloguePosition from);
  ~CatalogueWriter();  ///< drops waiting jobs
  CatalogueWriter(const CatalogueWriter&) = delete;
  CatalogueWriter& operator=(const CatalogueWriter&) = delete;

  /// Adds a new object with the key `first_view.object`. Waits while too much is queued. False: rejected,
  /// because there was no room and no progress.
  [[nodiscard]] bool addObject(ObjectView first_view);
  /// Whether another view of the object may be added now: half of the room is reserved for new objects.
  [[nodiscard]] bool hasRoomForView(ObjectId object);
  /// Adds a view of view.object. Dropped if the object is deleted by then.
  void addView(ObjectView view);
  /// Merges two objects, unless users have settled both, separated them or deleted one by then. `join`: the
  /// number of a user's join of their regions, for part(); only a deleted object is not merged then.
  void merge(ObjectId a, ObjectId b, int join = 0);
  /// A user undid that join: its merges are undone, unless others have changed them since. `earlier`: its
  /// merges, if an earlier scan made them.
  void part(int join, std::vector<ObjectMerge> earlier);
  /// A user names the object (ObjectDatabase::nameByUser), unless it is deleted by then. `naming`: a
  /// number for revertNaming(). `again`: the number of a reverted naming to redo; does nothing if others
  /// overruled it.
  void name(int naming, ObjectId object, const GivenName& given, int again = 0);
  /// Reverts that naming, except for later changes by others. `earlier`: its effect, if an earlier scan
  /// made it.
  void revertNaming(int naming, std::optional<ObjectNaming> earlier = std::nullopt);
  /// Removes an object that was made for an undone operation (see ObjectDatabase::withdraw).
  void withdraw(ObjectId object);
  /// Removes views of the object that this scan cropped from those frames, because they show something else
  /// or better ones replace them (ObjectDatabase::discardViews()). Does nothing if a user has settled the
  /// object by then.
  void discardViews(ObjectId object, std::vector<int> frames);
  /// Requests the changes by others. While a server announces them, reads them only then, and else once a
  /// second.
  void requestChanges();

  /// Events since the last call, in order.
  [[nodiscard]] std::vector<CatalogueEvent> drainEvents();

  /// Waits until all jobs are done and all changes by others so far are among the events. False: not within
  /// `limit`.
  [[nodiscard]] bool settle(std::chrono::milliseconds limit);

  /// After finish(): the session, and the newest event that was read.
  [[nodiscard]] std::int64_t session() const { return executor_.session(); }
  [[nodiscard]] std::int64_t lastEvent() const { return executor_.lastEvent(); }

  /// Ends the session and the thread after all jobs. Calls `listener` when events can be drained, and at
  /// the end. Only drainEvents() may be called afterwards. Error: what was not stored, and why; or no
  /// progress within Options::patience.
  [[nodiscard]] Result<void> finish(const std::function<void()>& listener = [] {});

 private:
  /// Kinds of jobs, for counting.
  struct Losses {
    int objects = 0, views = 0, merges = 0, names = 0;
    void count(const CatalogueJob& job);
  };
  using Events = CatalogueJobs::Events;

  explicit CatalogueWriter(Options options);

  // On the scan's thread.
  void enqueue(CatalogueJob job);
  void readChangesSoon();  // also on the thread of the notifications
  void close();
  [[nodiscard]] Error lossesInWords(const Losses& losses, const Error& reason) const;

  // On the writer's thread.
  void run(CataloguePosition from, std::promise<Result<void>> opened);
  void work();
  void readEdits();
  void doFirst();
  void notify(Events events);
  void noteFailure(const Error& error);
  void noteSuccess();

  const Options options_;

  // Only for the writer's thread.
  CatalogueJobs executor_;
  bool is_failure_reported_ = false;

  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::deque<CatalogueJob> jobs_;  // the first one is in progress
  std::size_t waiting_bytes_ = 0;
  bool are_changes_requested_ = false;
  std::chrono::steady_clock::time_point changes_read_;  // when they were last requested
  bool is_reading_changes_ = false;
  bool is_closed_ = false;
  std::uint64_t done_ = 0;  // number of jobs
  Events events_;
  Losses refused_;
  std::optional<Error> last_error_, last_refusal_;

  // Only for the scan's thread.
  bool is_full_ = false;             // and waiting for room was in vain
  std::set<ObjectId> without_room_;  // objects with a view worth storing

  std::thread thread_;                                  // uses all members above
  std::unique_ptr<ServerNotifications> notifications_;  // likewise; null: the catalogue is a file
};

}  // namespace scantrove
