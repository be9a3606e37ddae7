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

/// Stores what a scan finds, on a thread of its own with a connection of its own: SQL and the encoding of
/// images take nothing from the frames. Jobs are done in the order in which they came, so the same scan gives
/// the same catalogue; one that fails because the catalogue cannot be written for now (locked, full disk) is
/// tried again until it is done, and the others wait. What is stored comes back as events, and only then:
/// what is announced is committed. All functions for one thread, the scan's; none but settle() and finish()
/// waits for the database (addObject() when very much waits).
///
/// Objects that are not stored yet are known by the keys that addObject() was given; all jobs take both keys
/// and the database's ids.
class CatalogueWriter {
 public:
  struct Options {
    std::string database = {};                  ///< as ObjectDatabase::open takes it
    std::string source = {};                    ///< of the session that is begun
    std::optional<Intrinsics> camera = {};      ///< its depth camera, where it is known
    std::int64_t session = 0;                   ///< one that continues; 0: one is begun
    std::map<ObjectId, ObjectId> ids = {};      ///< of the objects that it added, by key
    std::function<void()> on_events = {};       ///< events wait to be taken; called on the writer's thread
    std::chrono::milliseconds retry{500};       ///< after a failure
    std::chrono::milliseconds patience{20000};  ///< of finish(), while nothing gets done
    std::chrono::milliseconds room_patience{5000};     ///< of addObject(), while there is no room
    std::size_t most_bytes = std::size_t{256} << 20U;  ///< of images that wait; half of it for further views
  };

  /// Opens the catalogue on the new thread; events are what happens after `from`. The session begins with the
  /// first job. Error: it cannot be opened.
  [[nodiscard]] static Result<std::unique_ptr<CatalogueWriter>> start(const Options& options,
                                                                      CataloguePosition from);
  ~CatalogueWriter();  ///< gives up what waits
  CatalogueWriter(const CatalogueWriter&) = delete;
  CatalogueWriter& operator=(const CatalogueWriter&) = delete;

  /// A new object, known by the key `first_view.object` from now on. Waits while too much waits already.
  /// False: it was not taken, there is no room and nothing gets done.
  [[nodiscard]] bool addObject(ObjectView first_view);
  /// Whether another view of the object may be added now: new objects keep half of the room.
  [[nodiscard]] bool hasRoomForView(ObjectId object);
  /// Another view of view.object. Dropped when that was deleted by the time.
  void addView(ObjectView view);
  /// Makes one of two objects, unless by the time persons settled both, parted them or deleted one.
  void merge(ObjectId a, ObjectId b);
  /// A person calls the object so (see ObjectDatabase::nameByUser), unless it was deleted by the time.
  /// `naming`: a number for takeNameBack(). `again`: of the naming that was taken back and is done again
  /// here; where others had overruled that, nothing is done.
  void name(int naming, ObjectId object, const std::string& name, int again = 0);
  /// What that naming did is taken back, unless others have said otherwise by the time.
  /// `earlier`: what it did, where it was of an earlier scan.
  void takeNameBack(int naming, std::optional<ObjectNaming> earlier = std::nullopt);
  /// An object that was made for something which a person took back is removed (see
  /// ObjectDatabase::withdraw).
  void withdraw(ObjectId object);
  /// Views of the object that this scan took from those frames show something else. See
  /// ObjectDatabase::discardViews(); nothing is done when a person has settled what it is by the time.
  void discardViews(ObjectId object, std::vector<int> frames);
  /// Asks for what others did to the catalogue.
  void follow();

  /// What happened since the last call, in order.
  [[nodiscard]] std::vector<CatalogueEvent> drainEvents();

  /// Waits until all jobs are done and what others did by now is among the events. False: not within `limit`.
  [[nodiscard]] bool settle(std::chrono::milliseconds limit);

  /// After finish(): the session, and the newest event that is known of the catalogue.
  [[nodiscard]] std::int64_t session() const { return executor_.session(); }
  [[nodiscard]] std::int64_t lastEvent() const { return executor_.lastEvent(); }

  /// Ends the session and the thread, after all jobs. `listener` is called when events have come (for
  /// drainEvents()), and at the end. No other call but drainEvents() afterwards. Error: what was not stored,
  /// and why; Options::patience passed without anything getting done.
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

  // The writer's thread's alone.
  CatalogueJobs executor_;
  bool is_failure_said_ = false;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<CatalogueJob> jobs_;  // the first one is being done
  std::size_t waiting_bytes_ = 0;
  bool is_follow_wanted_ = false;
  bool is_following_ = false;
  bool is_closed_ = false;
  std::uint64_t done_ = 0;  // jobs
  Events events_;
  Losses refused_;
  std::optional<Error> last_error_, last_refusal_;

  // The scan's thread's alone.
  bool is_full_ = false;             // and was waited for in vain
  std::set<ObjectId> without_room_;  // objects of which a view was worth keeping

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace scantrove
