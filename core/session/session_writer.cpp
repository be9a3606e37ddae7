#include "core/session/session_writer.h"

#include <utility>

#include "core/base/thread_priority.h"

namespace scantrove {

Result<std::unique_ptr<SessionWriter>> SessionWriter::start(const std::filesystem::path& folder, Way way) {
  std::unique_ptr<SessionWriter> writer(new SessionWriter(folder));
  writer->thread_ = std::thread([self = writer.get(), way] { self->run(way); });
  std::unique_lock lock(writer->mutex_);
  writer->changed_.wait(lock, [&] { return writer->opened_.has_value(); });
  if (!*writer->opened_) {
    const Error error = writer->opened_->error();
    lock.unlock();
    return fail(error);
  }
  lock.unlock();
  return writer;
}

SessionWriter::~SessionWriter() {
  {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool SessionWriter::open(Way way, std::unique_ptr<SessionStore>& store) {
  const std::filesystem::path folder = this->folder();
  Result<void> outcome =
      moveInto(store, way == Way::create ? SessionStore::create(folder) : SessionStore::open(folder));
  const bool is_open = outcome.has_value();
  {
    const std::scoped_lock lock(mutex_);
    opened_ = std::move(outcome);
  }
  changed_.notify_all();
  return is_open;
}

void SessionWriter::run(Way way) {
  lowerThreadPriority(Niceness::session_writer);
  std::unique_ptr<SessionStore> store;  // its database belongs to this thread
  if (!open(way, store)) return;
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto has_work = [this] { return !jobs_.empty() && (!failure_ || try_again_); };
    changed_.wait(lock, [&] { return is_closed_ || has_work(); });
    if (jobs_.empty() || (is_closed_ && failure_ && !try_again_)) return;
    try_again_ = false;
    const Job& job = jobs_.front();  // nobody else removes it
    lock.unlock();
    Result<void> outcome = doJob(job, *store);
    lock.lock();
    if (outcome) {
      failure_.reset();
      is_failure_reported_ = false;
      jobs_.pop_front();
    } else {
      failure_ = outcome.error();
    }
    changed_.notify_all();
  }
}

Result<void> SessionWriter::doJob(const Job& job, SessionStore& store) {
  Result<std::optional<Error>> disturbed = store.keepInPlace();
  if (!disturbed) return fail(disturbed.error());
  if (*disturbed) {
    const std::scoped_lock lock(mutex_);
    folder_ = store.folder();
    if (!disturbance_) disturbance_ = **disturbed;
    unreported_disturbances_.push_back(std::move(**disturbed));
  }
  return job(store);
}

void SessionWriter::post(Job job) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.size() < kMaxWaiting || failure_; });
  jobs_.push_back(std::move(job));
  try_again_ = true;
  changed_.notify_all();
}

Result<void> SessionWriter::flush() {
  std::unique_lock lock(mutex_);
  try_again_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return jobs_.empty() || (failure_ && !try_again_); });
  if (failure_) return fail(*failure_);
  return {};
}

bool SessionWriter::isFailing() const {
  const std::scoped_lock lock(mutex_);
  return failure_.has_value();
}

std::optional<Error> SessionWriter::disturbance() const {
  const std::scoped_lock lock(mutex_);
  return disturbance_;
}

std::filesystem::path SessionWriter::folder() const {
  const std::scoped_lock lock(mutex_);
  return folder_;
}

std::optional<Error> SessionWriter::takeFailure() {
  const std::scoped_lock lock(mutex_);
  if (!unreported_disturbances_.empty()) {
    const Error error = std::move(unreported_disturbances_.front());
    unreported_disturbances_.pop_front();
    return error;
  }
  if (!failure_ || std::exchange(is_failure_reported_, true)) return std::nullopt;
  return failure_;
}

}  // namespace scantrove
