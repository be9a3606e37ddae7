#include "core/catalogue/catalogue_writer.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "core/base/thread_priority.h"
#include "core/base/urgent_end.h"
#include "core/compute/guarded.h"
#include "core/database/server_notifications.h"

namespace scantrove {
namespace {

/// Patience of finish() when the program must end soon, and the interval of checking for that.
constexpr std::chrono::milliseconds kUrgentPatience{500}, kPollInterval{100};
/// Of a server that announces changes: an announcement may be lost with a connection.
constexpr std::chrono::milliseconds kBetweenPolls{1000};

constexpr const char* kWaits = "What the scan finds waits until then.";

std::size_t bytesOf(const ObjectView& view) {
  std::size_t bytes = sizeof(ObjectView);
  for (const cv::Mat* image : {&view.color, &view.mask, &view.depth_mm})
    bytes += image->total() * image->elemSize();
  return bytes;
}

std::string countOf(int count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace

void CatalogueWriter::Losses::count(const CatalogueJob& job) {
  objects += std::holds_alternative<job::AddObject>(job) ? 1 : 0;
  views += std::holds_alternative<job::AddView>(job) ? 1 : 0;
  merges += std::holds_alternative<job::Merge>(job) ? 1 : 0;
  names += std::holds_alternative<job::Name>(job) || std::holds_alternative<job::RevertNaming>(job) ? 1 : 0;
}

CatalogueWriter::CatalogueWriter(Options options)
    : options_(std::move(options)),
      executor_({options_.database, options_.source, options_.camera, options_.session, options_.ids},
                [this](Events events) { notify(std::move(events)); }) {}

// --- The scan's thread.

Result<std::unique_ptr<CatalogueWriter>> CatalogueWriter::start(const Options& options,
                                                                CataloguePosition from) {
  std::unique_ptr<CatalogueWriter> writer(new CatalogueWriter(options));
  writer->jobs_.emplace_back(job::BeginSession{});
  std::promise<Result<void>> opened;
  std::future<Result<void>> is_open = opened.get_future();
  writer->thread_ = std::thread([self = writer.get(), from, opened = std::move(opened)]() mutable {
    self->run(from, std::move(opened));
  });
  SCANTROVE_TRY(is_open.get());
  writer->notifications_ =
      ServerNotifications::start(options.database, [self = writer.get()] { self->readChangesSoon(); });
  return writer;
}

CatalogueWriter::~CatalogueWriter() { close(); }

void CatalogueWriter::close() {
  notifications_.reset();
  {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void CatalogueWriter::enqueue(CatalogueJob job) {
  jobs_.push_back(std::move(job));
  changed_.notify_all();
}

bool CatalogueWriter::addObject(ObjectView first_view) {
  const std::size_t bytes = bytesOf(first_view);
  std::unique_lock lock(mutex_);
  const auto has_room = [&] { return waiting_bytes_ == 0 || waiting_bytes_ + bytes <= options_.most_bytes; };
  // After a wait in vain, later calls do not wait until there is progress.
  if (!has_room() && !is_full_) changed_.wait_for(lock, options_.room_patience, has_room);
  is_full_ = !has_room();
  if (is_full_) return false;
  waiting_bytes_ += bytes;
  enqueue(job::AddObject{std::move(first_view)});
  return true;
}

bool CatalogueWriter::hasRoomForView(ObjectId object) {
  const std::scoped_lock lock(mutex_);
  const bool has_room = waiting_bytes_ < options_.most_bytes / 2;
  if (!has_room) without_room_.insert(object);
  return has_room;
}

void CatalogueWriter::addView(ObjectView view) {
  without_room_.erase(view.object);
  const std::scoped_lock lock(mutex_);
  waiting_bytes_ += bytesOf(view);
  enqueue(job::AddView{std::move(view)});
}

void CatalogueWriter::merge(ObjectId a, ObjectId b, int join) {
  const std::scoped_lock lock(mutex_);
  enqueue(job::Merge{a, b, join});
}

void CatalogueWriter::part(int join, std::vector<ObjectMerge> earlier) {
  const std::scoped_lock lock(mutex_);
  enqueue(job::Part{join, std::move(earlier)});
}

void CatalogueWriter::name(int naming, ObjectId object, const GivenName& given, int again) {
  const std::scoped_lock lock(mutex_);
  enqueue(job::Name{naming, object, given, again});
}

void CatalogueWriter::revertNaming(int naming, std::optional<ObjectNaming> earlier) {
  const std::scoped_lock lock(mutex_);
  enqueue(job::RevertNaming{naming, std::move(earlier)});
}

void CatalogueWriter::withdraw(ObjectId object) {
  const std::scoped_lock lock(mutex_);
  enqueue(job::Withdraw{object});
}

void CatalogueWriter::discardViews(ObjectId object, std::vector<int> frames) {
  const std::scoped_lock lock(mutex_);
  enqueue(job::DiscardViews{object, std::move(frames)});
}

void CatalogueWriter::requestChanges() {
  if (notifications_ && notifications_->isListening()) {
    const std::scoped_lock lock(mutex_);
    if (std::chrono::steady_clock::now() - changes_read_ < kBetweenPolls) return;
  }
  readChangesSoon();
}

void CatalogueWriter::readChangesSoon() {
  const std::scoped_lock lock(mutex_);
  are_changes_requested_ = true;
  changes_read_ = std::chrono::steady_clock::now();
  changed_.notify_all();
}

CatalogueWriter::Events CatalogueWriter::drainEvents() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(events_, {});
}

bool CatalogueWriter::settle(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  are_changes_requested_ = true;
  changed_.notify_all();
  return changed_.wait_for(
      lock, limit, [this] { return jobs_.empty() && !are_changes_requested_ && !is_reading_changes_; });
}

Result<void> CatalogueWriter::finish(const std::function<void()>& listener) {
  {
    std::unique_lock lock(mutex_);
    enqueue(job::EndSession{});
    std::uint64_t done = done_;
    std::chrono::milliseconds waited{0}, waited_urgently{0};
    const auto has_appeared = [&] { return jobs_.empty() || done_ != done || !events_.empty(); };
    while (!jobs_.empty() && waited < options_.patience && waited_urgently < kUrgentPatience) {
      if (!changed_.wait_for(lock, kPollInterval, has_appeared)) {
        waited += kPollInterval;
        if (isEndUrgent()) waited_urgently += kPollInterval;
      }
      if (std::exchange(done, done_) != done) waited = waited_urgently = std::chrono::milliseconds(0);
      if (events_.empty()) continue;
      lock.unlock();
      listener();
      lock.lock();
    }
  }
  close();
  listener();
  // The thread has ended: this one owns all members now.
  Losses losses = refused_;
  for (const CatalogueJob& job : jobs_) losses.count(job);
  if (!without_room_.empty()) {
    spdlog::warn("The catalogue {} was busy for so long that views of {} were not kept.", options_.database,
                 countOf(static_cast<int>(without_room_.size()), "object", "objects"));
  }
  if (jobs_.empty() && losses.objects + losses.views + losses.merges + losses.names == 0) return {};
  const std::optional<Error>& reason = jobs_.empty() ? last_refusal_ : last_error_;
  return fail(
      lossesInWords(losses, reason.value_or(Error{"It did not answer for so long.", "Check its disk."})));
}

Error CatalogueWriter::lossesInWords(const Losses& losses, const Error& reason) const {
  std::string lost;
  const auto add = [&](int count, const char* one, const char* many) {
    if (count > 0) lost += (lost.empty() ? "" : ", ") + countOf(count, one, many);
  };
  add(losses.objects, "new object", "new objects");
  add(losses.views, "view", "views");
  add(losses.merges, "merge", "merges");
  add(losses.names, "name", "names");
  if (lost.empty()) lost = "the end of this scan";
  return {"The catalogue " + options_.database + " has not got " + lost + ". " + reason.what, reason.advice};
}

// --- The writer's thread.

void CatalogueWriter::run(CataloguePosition from, std::promise<Result<void>> opened) {
  lowerThreadPriority(Niceness::catalogue_writer);
  const Result<void> open = guarded("opening the catalogue", [&] { return executor_.open(from); });
  opened.set_value(open);
  const Result<void> ended = guarded("storing in the catalogue", [&]() -> Result<void> {
    if (open) work();
    return {};
  });
  if (!ended) {  // out of memory even for a message: finish() reports what is left
    const std::scoped_lock lock(mutex_);
    last_error_ = ended.error();
  }
  executor_.close();
}

void CatalogueWriter::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_closed_ || are_changes_requested_ || !jobs_.empty(); });
    if (is_closed_) return;
    lock.unlock();
    // Edits of users come first: a job may depend on them.
    readEdits();
    doFirst();
    lock.lock();
  }
}

void CatalogueWriter::readEdits() {
  if (executor_.isInDoubt()) return;  // they stay requested
  {
    const std::scoped_lock lock(mutex_);
    if (!std::exchange(are_changes_requested_, false)) return;
    is_reading_changes_ = true;
  }
  Result<CatalogueEdits> edits = guarded("reading the catalogue", [this] { return executor_.readEdits(); });
  if (!edits) noteFailure(edits.error());
  if (edits && !edits->isEmpty()) notify({event::Edited{std::move(*edits)}});
  const std::scoped_lock lock(mutex_);
  if (edits && jobs_.empty()) is_failure_reported_ = false;
  is_reading_changes_ = false;
  changed_.notify_all();
}

void CatalogueWriter::doFirst() {
  CatalogueJob* job = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    if (jobs_.empty() || is_closed_) return;
    job = &jobs_.front();  // nobody else removes it, and a growing deque moves no elements
  }
  Result<CatalogueJobs::Outcome> done = executor_.attempt(*job);
  if (!done) {
    noteFailure(done.error());
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, options_.retry, [this] { return is_closed_; });
    return;
  }
  notify(std::move(done->events));
  noteSuccess();
  const std::scoped_lock lock(mutex_);
  if (done->refusal) {
    refused_.count(*job);
    last_refusal_ = done->refusal;
  }
  if (const auto* object = std::get_if<job::AddObject>(job)) waiting_bytes_ -= bytesOf(object->view);
  if (const auto* view = std::get_if<job::AddView>(job)) waiting_bytes_ -= bytesOf(view->view);
  jobs_.pop_front();
  ++done_;
  changed_.notify_all();
}

void CatalogueWriter::notify(Events events) {
  if (events.empty()) return;
  {
    const std::scoped_lock lock(mutex_);
    for (CatalogueEvent& one : events) events_.push_back(std::move(one));
    changed_.notify_all();
  }
  if (options_.on_events) options_.on_events();
}

void CatalogueWriter::noteFailure(const Error& error) {
  {
    const std::scoped_lock lock(mutex_);
    last_error_ = error;
  }
  if (std::exchange(is_failure_reported_, true)) {
    spdlog::debug("{}", error.message());
  } else {
    notify({event::Failed{{error.what, error.advice + (error.advice.empty() ? "" : " ") + kWaits}}});
  }
}

void CatalogueWriter::noteSuccess() {
  const std::scoped_lock lock(mutex_);
  if (jobs_.size() == 1) is_failure_reported_ = false;
}

}  // namespace scantrove
