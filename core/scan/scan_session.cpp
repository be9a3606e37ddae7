#include "core/scan/scan_session.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/scan/scan_run.h"

namespace scantrove {

/// The thread and what the window tells it. Everything under `mutex_` but the state is a wish that the thread
/// reads between frames.
class ScanSession::Worker {
 public:
  explicit Worker(Listener listener)
      : listener_(std::move(listener)), thread_([this](const std::stop_token& token) { loop(token); }) {}

  ~Worker() {
    wish([this] {
      wishes_.stop = true;
      wishes_.request.reset();
    });
    thread_.request_stop();
    changed_.notify_all();
  }

  void start(ScanRequest request) {
    wish([&] {
      wishes_ = Wishes{};
      wishes_.stop = true;  // ends the scan that runs, if one does
      wishes_.request = std::move(request);
    });
  }
  void pause() {
    wish([this] { wishes_.paused = true; });
  }
  void resume() {
    wish([this] { wishes_.paused = false; });
  }
  void step() {
    wish([this] { ++wishes_.steps; });
  }
  void stop() {
    wish([this] {
      wishes_.stop = true;
      wishes_.request.reset();
    });
  }
  void catalogueChanged() {
    wish([this] { wishes_.reload_catalogue = true; });
  }
  void setParams(const ScanParams& params) {
    wish([&] { wishes_.params = params; });
  }

  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !wishes_.request && !is_running_; });
  }

  std::atomic<ScanState> state{ScanState::idle};
  LatestValue<ScanSnapshot> mailbox;

 private:
  struct Wishes {
    std::optional<ScanRequest> request;
    bool stop = false;
    bool paused = false;
    int steps = 0;
    bool reload_catalogue = false;
    std::optional<ScanParams> params;
  };

  template <class Change>
  void wish(Change&& change) {
    {
      const std::scoped_lock lock(mutex_);
      change();
    }
    changed_.notify_all();
  }

  void loop(const std::stop_token& token) {
    while (!token.stop_requested()) {
      std::optional<ScanRequest> request;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return token.stop_requested() || wishes_.request; });
        if (token.stop_requested()) return;
        request = std::exchange(wishes_.request, std::nullopt);
        wishes_.stop = false;
        wishes_.paused = request->start_paused;
        is_running_ = true;
      }
      runScan(*request);
      wish([this] { is_running_ = false; });
    }
  }

  void enter(ScanState next) {
    if (state.exchange(next) != next) listener_(StateChanged{next});
  }

  void failWith(const Error& error) {
    listener_(ScanFailed{error});
    enter(ScanState::failed);
  }

  void runScan(const ScanRequest& request) {
    try {
      enter(ScanState::starting);
      Result<std::unique_ptr<ScanRun>> run = ScanRun::open(request, listener_, mailbox);
      if (!run) return failWith(run.error());
      const Result<void> scanned = scanFrames(**run);
      enter(ScanState::stopping);
      (*run)->showNow(scanned ? ScanState::finished : ScanState::failed);
      // Even when the scan broke off, what was scanned is kept.
      Result<ScanReport> report = (*run)->finish();
      if (!scanned) return failWith(scanned.error());
      if (!report) return failWith(report.error());
      listener_(ScanFinished{std::move(*report)});
      enter(ScanState::finished);
    } catch (const std::exception& error) {
      failWith(
          {std::string("The scan stopped: ") + error.what() + ".", "What was written until then is kept."});
    }
  }

  Result<void> scanFrames(ScanRun& run) {
    for (;;) {
      Wishes wishes;
      if (!awaitTurn(run, wishes)) return {};
      if (wishes.params) run.setParams(*wishes.params);
      if (wishes.reload_catalogue) SCANTROVE_TRY(run.reloadCatalogue());
      if (wishes.paused && wishes.steps == 0) continue;
      enter(wishes.paused ? ScanState::paused : ScanState::scanning);
      run.startClock();
      Result<ScanRun::Step> step = run.step();
      if (!step) return fail(step.error());
      if (*step == ScanRun::Step::end) return {};
      if (wishes.paused) {
        if (*step == ScanRun::Step::nothing_yet)
          wish([this] { ++wishes_.steps; });  // a step is one real frame
        run.stopClock();
        run.showNow(ScanState::paused);
      } else if (*step == ScanRun::Step::frame) {
        run.showWhenDue(ScanState::scanning);
      }
    }
  }

  /// Waits while paused without a wish. Takes the wishes of the moment; false = stop.
  bool awaitTurn(ScanRun& run, Wishes& taken) {
    std::unique_lock lock(mutex_);
    const auto has_wish = [this] {
      return !wishes_.paused || wishes_.stop || wishes_.steps > 0 || wishes_.reload_catalogue ||
             wishes_.params;
    };
    if (!has_wish()) {
      lock.unlock();
      run.stopClock();
      if (state != ScanState::paused) {
        if (run.hasFrames()) run.showNow(ScanState::paused);
        enter(ScanState::paused);
      }
      lock.lock();
      changed_.wait(lock, has_wish);
    }
    if (wishes_.stop) return false;
    taken.paused = wishes_.paused;
    taken.steps = wishes_.steps;
    if (wishes_.steps > 0) --wishes_.steps;
    taken.reload_catalogue = std::exchange(wishes_.reload_catalogue, false);
    taken.params = std::exchange(wishes_.params, std::nullopt);
    return true;
  }

  Listener listener_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Wishes wishes_;
  bool is_running_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

ScanSession::ScanSession(Listener listener) : worker_(std::make_unique<Worker>(std::move(listener))) {}
ScanSession::~ScanSession() = default;
void ScanSession::start(ScanRequest request) { worker_->start(std::move(request)); }
void ScanSession::pause() { worker_->pause(); }
void ScanSession::resume() { worker_->resume(); }
void ScanSession::step() { worker_->step(); }
void ScanSession::stop() { worker_->stop(); }
void ScanSession::wait() { worker_->wait(); }
void ScanSession::catalogueChanged() { worker_->catalogueChanged(); }
void ScanSession::setParams(const ScanParams& params) { worker_->setParams(params); }
ScanState ScanSession::state() const { return worker_->state; }
LatestValue<ScanSnapshot>& ScanSession::snapshots() { return worker_->mailbox; }

}  // namespace scantrove
