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

/// Writes a session on its own thread while a scan runs, so that frames do not wait for the disk. At most
/// kMaxWaiting jobs wait; with more, post() waits. All functions for one thread.
///
/// A failed job (the disk is full) is repeated with the next one and at the end. While isFailing(), callers
/// should not post more.
class SessionWriter {
 public:
  static constexpr std::size_t kMaxWaiting = 16;
  using Job = std::function<Result<void>(SessionStore&)>;

  enum class Way { create, open };
  /// Error: as SessionStore::create and open.
  [[nodiscard]] static Result<std::unique_ptr<SessionWriter>> start(const std::filesystem::path& folder,
                                                                    Way way);
  ~SessionWriter();  ///< waits for the posted jobs
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;

  void post(Job job);
  /// Waits until all posted jobs are done. Error: the first failed job, with all after it.
  [[nodiscard]] Result<void> flush();
  [[nodiscard]] bool isFailing() const;
  /// Why a job failed, once for each series of failures.
  [[nodiscard]] std::optional<Error> takeFailure();
  /// Reports once that other programs removed, moved or replaced files of the session; it was written
  /// again.
  [[nodiscard]] std::optional<Error> disturbance() const;

  /// Changes when the folder is moved.
  [[nodiscard]] std::filesystem::path folder() const;

 private:
  explicit SessionWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void run(Way way);
  [[nodiscard]] bool open(Way way, std::unique_ptr<SessionStore>& store);
  /// First checks whether the session is still in place.
  [[nodiscard]] Result<void> doJob(const Job& job, SessionStore& store);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Guarded by mutex_:
  std::filesystem::path folder_;
  std::deque<Job> jobs_;  // the first stays while it runs or fails
  std::optional<Result<void>> opened_;
  std::optional<Error> failure_;  // of the first job, while it fails
  bool is_failure_reported_ = false;
  std::optional<Error> disturbance_;
  std::deque<Error> unreported_disturbances_;
  bool try_again_ = false;
  bool is_closed_ = false;
  std::thread thread_;  // last: uses all members above
};

}  // namespace scantrove
