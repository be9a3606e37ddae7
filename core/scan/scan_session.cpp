#include "core/scan/scan_session.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/compute/guarded.h"
#include "core/scan/first_error.h"
#include "core/scan/scan_review.h"
#include "core/scan/scan_run.h"

namespace scantrove {

/// The thread and the commands that it has been given; it takes them between frames.
class ScanSession::Worker {
 public:
  Worker(Listener listener, Niceness niceness)
      : listener_(std::move(listener)), thread_([this, niceness](const std::stop_token& token) {
          lowerThreadPriority(niceness);
          loop(token);
        }) {}

  ~Worker() {
    command([this] {
      commands_.stop = true;
      commands_.request.reset();
    });
    command([this] { thread_.request_stop(); });
    cancelExport();
  }

  void start(ScanRequest request) {
    cancelExport();
    command([&] {
      // What a person did to the scan that runs is done before it ends.
      std::vector<ScanEdit> edits = std::move(commands_.edits);
      commands_ = Commands{};
      commands_.last_edits = std::move(edits);
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
  void close() {
    cancelExport();
    command([this] {
      commands_.stop = true;
      commands_.close = true;
      commands_.request.reset();
    });
  }
  void skipRefinement() {
    command([this] { commands_.skip_refinement = true; });
  }
  void edit(ScanEdit edit) {
    command([&] { commands_.edits.push_back(std::move(edit)); });
  }
  void showKeyFrame(int place) {
    command([&] { commands_.key_frame = place; });
  }
  void previewExport(ExportOptions options) {
    command([&] { commands_.preview = std::move(options); });
  }
  void sampleExport(ExportOptions options, std::optional<int> place) {
    command([&] { commands_.sample = {std::move(options), place}; });
  }
  void exportDataset(ExportOptions options) {
    command([&] {
      export_stop_ = std::stop_source();
      commands_.dataset = std::move(options);
    });
  }
  void cancelExport() {
    command([this] { export_stop_.request_stop(); });
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
    bool close = false;  // nor look at what was scanned
    bool skip_refinement = false;
    bool paused = false;
    int steps = 0;
    bool follow_catalogue = false;
    std::vector<ScanEdit> edits;
    std::vector<ScanEdit> last_edits;  // of the scan before the one that is asked for
    std::optional<ScanParams> params;
    std::optional<int> key_frame;
    std::optional<ExportOptions> preview, dataset;
    std::optional<std::pair<ExportOptions, std::optional<int>>> sample;
    std::stop_token export_stop;
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
      std::vector<ScanEdit> late;  // of the scan before
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return token.stop_requested() || commands_.request; });
        if (token.stop_requested()) return;
        request = std::exchange(commands_.request, std::nullopt);
        commands_.stop = false;
        commands_.skip_refinement = request->skip_refinement;
        commands_.paused = request->start_paused;
        late = std::exchange(commands_.last_edits, {});
        is_running_ = true;
      }
      params_ = request->params;
      for (const ScanEdit& edit : late)
        listener_(EditFailed{edit, {"The scan that it was about has ended.", ""}});
      const bool is_scan = request->refine_session || !request->source.empty();
      const bool is_open = !is_scan || runScan(*request);
      if (is_open && request->review && request->output_folder) review(*request, token);
      command([this] { is_running_ = false; });
    }
  }

  void enter(ScanState next) {
    if (state.exchange(next) != next) listener_(StateChanged{next});
  }

  /// Who closes the program or starts another scan does not wait for what can be done later.
  bool isRefinementSkipped() {
    const std::scoped_lock lock(mutex_);
    return commands_.skip_refinement || commands_.close || commands_.request ||
           thread_.get_stop_token().stop_requested();
  }

  void failWith(const Error& error) {
    listener_(ScanFailed{error});
    enter(ScanState::failed);
  }

  /// Whether it came to its end.
  bool runScan(const ScanRequest& request) {
    enter(ScanState::starting);
    Result<std::unique_ptr<ScanRun>> run = guarded("preparing the scan", [&] {
      return ScanRun::open(request, listener_, mailbox, [this] { catalogueChanged(); });
    });
    if (!run) {
      failWith(run.error());
      return false;
    }
    FirstError outcome;
    if (!request.refine_session) outcome.note(guarded("during the scan", [&] { return scanFrames(**run); }));
    enter(ScanState::finishing);
    const ScanState end = outcome.result() ? ScanState::finished : ScanState::failed;
    outcome.note(guarded("showing the end of the scan", [&] { return (*run)->showNow(end); }));
    // Even when the scan broke off, what was scanned is kept.
    Result<ScanReport> report = guarded("ending the scan", [&] {
      return (*run)->finish(
          {[this] { return !isRefinementSkipped(); }, [this](ScanState now) { enter(now); }});
    });
    if (!report) outcome.note(fail(report.error()));
    if (!outcome.result()) {
      failWith(outcome.result().error());
      return false;
    }
    listener_(ScanFinished{std::move(*report)});
    enter(ScanState::finished);
    return true;
  }

  /// The session of `request` is open until something else is asked for.
  void review(const ScanRequest& request, const std::stop_token& token) {
    const bool is_after_scan = request.refine_session || !request.source.empty();
    {
      const std::scoped_lock lock(mutex_);
      if (commands_.close) return;
      is_running_ = !is_after_scan;  // who waits for the scan need not wait for this
      commands_.stop = false;
    }
    changed_.notify_all();
    if (!is_after_scan) enter(ScanState::starting);
    Result<std::unique_ptr<ScanReview>> review = guarded(
        "opening the session", [&] { return ScanReview::open(request, params_, listener_, mailbox); });
    if (!review) return failWith(review.error());
    FirstError outcome;
    outcome.note(guarded("showing the session", [&] { return (*review)->showAll(); }));
    if (!is_after_scan) enter(ScanState::finished);
    command([this] { is_running_ = false; });
    listener_(ReviewOpened{(*review)->canBeRefined()});
    while (outcome.result()) {
      Commands commands;
      if (!awaitReviewer(commands, token)) return;
      outcome.note(guarded("working on the session", [&] { return serve(**review, commands); }));
    }
    failWith(outcome.result().error());
  }

  Result<void> serve(ScanReview& review, Commands& commands) {
    for (const ScanEdit& edit : commands.edits) SCANTROVE_TRY(review.edit(edit));
    if (commands.params) SCANTROVE_TRY(review.setParams(*commands.params));
    if (commands.key_frame) SCANTROVE_TRY(review.showKeyFrame(*commands.key_frame));
    if (commands.preview) review.previewExport(*commands.preview);
    if (commands.sample) review.sampleExport(commands.sample->first, commands.sample->second);
    if (commands.dataset) review.exportDataset(*commands.dataset, commands.export_stop);
    return {};
  }

  /// Waits for something to do. False: something else is asked for, after the edits in `taken`.
  bool awaitReviewer(Commands& taken, const std::stop_token& token) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] {
      return token.stop_requested() || commands_.close || commands_.request || !commands_.edits.empty() ||
             commands_.params || commands_.key_frame || commands_.preview || commands_.sample ||
             commands_.dataset;
    });
    taken.edits = takeEdits();
    if ((token.stop_requested() || commands_.close || commands_.request) && taken.edits.empty()) return false;
    taken.params = std::exchange(commands_.params, std::nullopt);
    taken.key_frame = std::exchange(commands_.key_frame, std::nullopt);
    taken.preview = std::exchange(commands_.preview, std::nullopt);
    taken.sample = std::exchange(commands_.sample, std::nullopt);
    taken.dataset = std::exchange(commands_.dataset, std::nullopt);
    taken.export_stop = export_stop_.get_token();
    return true;
  }

  Result<void> scanFrames(ScanRun& run) {
    for (;;) {
      Commands commands;
      SCANTROVE_TRY(awaitTurn(run, commands));
      if (commands.params) {
        run.setParams(*commands.params);
        params_ = *commands.params;
      }
      for (const ScanEdit& edit : commands.edits) run.edit(edit);
      if (commands.preview || commands.sample || commands.dataset) refuseExport();
      if (commands.stop) return {};
      if (commands.paused && commands.steps == 0) {
        SCANTROVE_TRY(showPaused(run, commands));
        continue;
      }
      // Who has just done something sees it before the next frame is through.
      if (!commands.edits.empty() && !commands.paused && run.hasFrames())
        SCANTROVE_TRY(run.showWhenDue(ScanState::scanning));
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

  /// What commands change of the frame that a paused scan shows.
  Result<void> showPaused(ScanRun& run, const Commands& commands) {
    const bool is_news = commands.follow_catalogue && run.followCatalogue();
    if (!run.hasFrames()) return {};
    if (commands.params) SCANTROVE_TRY(run.segmentAgain());
    if (!is_news && !commands.params && commands.edits.empty()) return {};
    return run.showNow(ScanState::paused);
  }

  /// Waits while paused without a command, then takes the commands of the moment.
  Result<void> awaitTurn(ScanRun& run, Commands& taken) {
    std::unique_lock lock(mutex_);
    const auto has_command = [this] {
      return !commands_.paused || commands_.stop || commands_.steps > 0 || commands_.follow_catalogue ||
             commands_.params || commands_.preview || commands_.sample || commands_.dataset ||
             !commands_.edits.empty();
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
    taken.edits = takeEdits();
    taken.params = std::exchange(commands_.params, std::nullopt);
    taken.preview = std::exchange(commands_.preview, std::nullopt);
    taken.sample = std::exchange(commands_.sample, std::nullopt);
    taken.dataset = std::exchange(commands_.dataset, std::nullopt);
    return {};
  }

  /// Those of the scan that runs; mutex_ is held.
  std::vector<ScanEdit> takeEdits() {
    return std::exchange(commands_.request ? commands_.last_edits : commands_.edits, {});
  }

  void refuseExport() {
    listener_(ExportFailed{{"A data set is made of a scan that has ended.", "Stop the scan first."}});
  }

  Listener listener_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Commands commands_;  // guarded by mutex_
  bool is_running_ = false;
  ScanParams params_;             // as they were set last; the worker's
  std::stop_source export_stop_;  // guarded by mutex_
  std::jthread thread_;           // last: it uses all of the above
};

ScanSession::ScanSession(Listener listener, Niceness niceness)
    : worker_(std::make_unique<Worker>(std::move(listener), niceness)) {}
ScanSession::~ScanSession() = default;
void ScanSession::start(ScanRequest request) { worker_->start(std::move(request)); }
void ScanSession::pause() { worker_->pause(); }
void ScanSession::resume() { worker_->resume(); }
void ScanSession::step() { worker_->step(); }
void ScanSession::stop() { worker_->stop(); }
void ScanSession::close() { worker_->close(); }
void ScanSession::skipRefinement() { worker_->skipRefinement(); }
void ScanSession::wait() { worker_->wait(); }
void ScanSession::edit(ScanEdit edit) { worker_->edit(std::move(edit)); }
void ScanSession::showKeyFrame(int place) { worker_->showKeyFrame(place); }
void ScanSession::previewExport(ExportOptions options) { worker_->previewExport(std::move(options)); }
void ScanSession::sampleExport(ExportOptions options, std::optional<int> place) {
  worker_->sampleExport(std::move(options), place);
}
void ScanSession::exportDataset(ExportOptions options) { worker_->exportDataset(std::move(options)); }
void ScanSession::cancelExport() { worker_->cancelExport(); }
void ScanSession::catalogueChanged() { worker_->catalogueChanged(); }
void ScanSession::setParams(const ScanParams& params) { worker_->setParams(params); }
ScanState ScanSession::state() const { return worker_->state; }
LatestValue<ScanSnapshot>& ScanSession::snapshots() { return worker_->mailbox; }

}  // namespace scantrove
