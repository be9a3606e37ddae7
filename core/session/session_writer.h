#pragma once
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/result.h"
#include "core/session/session_store.h"

namespace scantrove {

/// Keeps a session on disk beside a scan, on a thread of its own, so that no frame waits for the disk. At
/// most kMaxWaiting jobs wait; with more, post() waits. All functions for one thread.
///
/// A job that fails (the disk is full) is tried again with the next one and at the end; meanwhile isFailing()
/// says that it is better not to hand over more.
class SessionWriter {
 public:
  static constexpr std::size_t kMaxWaiting = 16;
  using Job = std::function<Result<void>(SessionStore&)>;

  enum class Way { create, open };
  /// Error: as SessionStore::create and open.
  [[nodiscard]] static Result<std::unique_ptr<SessionWriter>> start(const std::filesystem::path& folder,
                                                                    Way way);
  ~SessionWriter();  ///< waits for the jobs that were taken
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;

  void post(Job job);
  /// Waits until all that was posted is done. Error: the first that is not, with all that came after it.
  [[nodiscard]] Result<void> flush();
  [[nodiscard]] bool isFailing() const;
  /// Why a job failed, once for each time that jobs begin to fail.
  [[nodiscard]] std::optional<Error> takeFailure();
  /// The first time that other programs removed, moved or replaced files of the session; it was written anew.
  [[nodiscard]] std::optional<Error> disturbance() const;

  /// It changes when the folder is moved.
  [[nodiscard]] std::filesystem::path folder() const;

 private:
  explicit SessionWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void run(Way way);
  [[nodiscard]] bool open(Way way, std::unique_ptr<SessionStore>& store);
  /// Looks first whether the session is still in place.
  [[nodiscard]] Result<void> doJob(const Job& job, SessionStore& store);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Guarded by mutex_:
  std::filesystem::path folder_;
  std::deque<Job> jobs_;  // the first stays while it is done, and while it fails
  std::optional<Result<void>> opened_;
  std::optional<Error> failure_;  // of the first job, as long as it fails
  bool is_failure_said_ = false;
  std::optional<Error> disturbance_;
  std::deque<Error> unsaid_disturbances_;
  bool try_again_ = false;
  bool is_closed_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace scantrove
