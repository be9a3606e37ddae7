#include "core/scan/scan_session.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/scan/first_error.h"
#include "core/scan/guarded.h"
#include "core/scan/scan_run.h"

namespace scantrove {

/// The thread and the commands that it has been given; it takes them between frames.
class ScanSession::Worker {
 public:
  explicit Worker(Listener listener)
      : listener_(std::move(listener)), thread_([this](const std::stop_token& token) { loop(token); }) {}

  ~Worker() {
    command([this] {
      commands_.stop = true;
      commands_.request.reset();
    });
    thread_.request_stop();
    changed_.notify_all();
  }

  void start(ScanRequest request) {
    command([&] {
      commands_ = Commands{};
      commands_.stop = true;  // ends the scan that runs, if one does
      commands_.request = std::move(request);
    });
  }
  void pause() {
    command([this] { commands_.paused = true; });
  }
  void resume() {
    command([this] { commands_.paused = false; });
  }
  void step() {
    command([this] { ++commands_.steps; });
  }
  void stop() {
    command([this] {
      commands_.stop = true;
      commands_.request.reset();
    });
  }
  void addCandidate(RegionId region) {
    command([&] { commands_.wanted.push_back(region); });
  }
  void edit(ScanEdit edit) {
    command([&] { commands_.edits.push_back(std::move(edit)); });
  }
  void catalogueChanged() {
    command([this] { commands_.follow_catalogue = true; });
  }
  void setParams(const ScanParams& params) {
    command([&] { commands_.params = params; });
  }

  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !commands_.request && !is_running_; });
  }

  std::atomic<ScanState> state{ScanState::idle};
  LatestValue<ScanSnapshot> mailbox;

 private:
  struct Commands {
    std::optional<ScanRequest> request;
    bool stop = false;
    bool paused = false;
    int steps = 0;
    bool follow_catalogue = false;
    std::vector<RegionId> wanted;
    std::vector<ScanEdit> edits;
    std::optional<ScanParams> params;
  };

  template <class Change>
  void command(Change&& change) {
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
        changed_.wait(lock, [&] { return token.stop_requested() || commands_.request; });
        if (token.stop_requested()) return;
        request = std::exchange(commands_.request, std::nullopt);
        commands_.stop = false;
        commands_.paused = request->start_paused;
        is_running_ = true;
      }
      runScan(*request);
      command([this] { is_running_ = false; });
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
    enter(ScanState::starting);
    Result<std::unique_ptr<ScanRun>> run = guarded("preparing the scan", [&] {
      return ScanRun::open(request, listener_, mailbox, [this] { catalogueChanged(); });
    });
    if (!run) return failWith(run.error());
    FirstError outcome;
    outcome.note(guarded("during the scan", [&] { return scanFrames(**run); }));
    enter(ScanState::stopping);
    const ScanState end = outcome.result() ? ScanState::finished : ScanState::failed;
    outcome.note(guarded("showing the end of the scan", [&] { return (*run)->showNow(end); }));
    // Even when the scan broke off, what was scanned is kept.
    Result<ScanReport> report = guarded("ending the scan", [&] { return (*run)->finish(); });
    if (!report) outcome.note(fail(report.error()));
    if (!outcome.result()) return failWith(outcome.result().error());
    listener_(ScanFinished{std::move(*report)});
    enter(ScanState::finished);
  }

  Result<void> scanFrames(ScanRun& run) {
    for (;;) {
      Commands commands;
      SCANTROVE_TRY(awaitTurn(run, commands));
      if (commands.stop) return {};
      if (commands.params) run.setParams(*commands.params);
      for (const RegionId region : commands.wanted) run.addCandidate(region);
      for (const ScanEdit& edit : commands.edits) run.edit(edit);
      if (commands.paused && commands.steps == 0) {
        const bool is_news = commands.follow_catalogue && run.followCatalogue();
        if ((is_news || !commands.edits.empty()) && run.hasFrames())
          SCANTROVE_TRY(run.showNow(ScanState::paused));
        continue;
      }
      enter(commands.paused ? ScanState::paused : ScanState::scanning);
      run.startClock();
      Result<ScanRun::Step> step = run.step();
      if (!step) return fail(step.error());
      if (*step == ScanRun::Step::end) return {};
      if (commands.paused) {
        if (*step == ScanRun::Step::nothing_yet)
          command([this] { ++commands_.steps; });  // a step is one real frame
        run.stopClock();
        SCANTROVE_TRY(run.showNow(ScanState::paused));
      } else if (*step == ScanRun::Step::frame) {
        SCANTROVE_TRY(run.showWhenDue(ScanState::scanning));
      }
    }
  }

  /// Waits while paused without a command, then takes the commands of the moment.
  Result<void> awaitTurn(ScanRun& run, Commands& taken) {
    std::unique_lock lock(mutex_);
    const auto has_command = [this] {
      return !commands_.paused || commands_.stop || commands_.steps > 0 || commands_.follow_catalogue ||
             commands_.params || !commands_.edits.empty();
    };
    if (!has_command()) {
      lock.unlock();
      run.stopClock();
      if (state != ScanState::paused) {
        if (run.hasFrames()) SCANTROVE_TRY(run.showNow(ScanState::paused));
        enter(ScanState::paused);
      }
      lock.lock();
      changed_.wait(lock, has_command);
    }
    taken.stop = commands_.stop;
    taken.paused = commands_.paused;
    taken.steps = commands_.steps;
    if (commands_.steps > 0) --commands_.steps;
    taken.follow_catalogue = std::exchange(commands_.follow_catalogue, false);
    taken.wanted = std::exchange(commands_.wanted, {});
    taken.edits = std::exchange(commands_.edits, {});
    taken.params = std::exchange(commands_.params, std::nullopt);
    return {};
  }

  Listener listener_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Commands commands_;  // guarded by mutex_
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
void ScanSession::addCandidate(RegionId region) { worker_->addCandidate(region); }
void ScanSession::edit(ScanEdit edit) { worker_->edit(std::move(edit)); }
void ScanSession::catalogueChanged() { worker_->catalogueChanged(); }
void ScanSession::setParams(const ScanParams& params) { worker_->setParams(params); }
ScanState ScanSession::state() const { return worker_->state; }
LatestValue<ScanSnapshot>& ScanSession::snapshots() { return worker_->mailbox; }

}  // namespace scantrove
