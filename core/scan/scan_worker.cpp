#include "core/scan/scan_worker.h"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/base/first_error.h"
#include "core/base/overloaded.h"
#include "core/compute/guarded.h"
#include "core/scan/scan_review.h"
#include "core/scan/scan_run.h"

namespace scantrove {
namespace {

template <class Command, class... Others>
constexpr bool kIsOneOf = (std::is_same_v<Command, Others> || ...);

template <class Command>
constexpr bool kNewestReplaces =
    kIsOneOf<Command, ShowKeyFrame, LabelKeyFrame, SetParams, ApplyCatalogueChanges, PreviewExport,
             SampleExport, ExportDataset, ExportProject>;

template <class Command>
constexpr bool kEndsScan = kIsOneOf<Command, StartScan, CloseScan>;

template <class Command>
bool is(const ScanCommand& command) {
  return std::holds_alternative<Command>(command);
}

/// Whether somebody waits for its end.
bool isExport(const ScanCommand& command) {
  return is<ExportDataset>(command) || is<ExportProject>(command) || is<RenderPicture>(command);
}

}  // namespace

ScanWorker::ScanWorker(ScanListener listener, Niceness niceness)
    : listener_(std::move(listener)), thread_([this, niceness](const std::stop_token& token) {
        lowerThreadPriority(niceness);
        loop(token);
      }) {}

ScanWorker::~ScanWorker() {
  post(CloseScan{});
  {
    const std::scoped_lock lock(mutex_);
    thread_.request_stop();
  }
  changed_.notify_all();
}

void ScanWorker::post(ScanCommand command) {
  {
    const std::scoped_lock lock(mutex_);
    std::visit(
        [this]<class Command>(const Command&) {
          if (kEndsScan<Command> || kIsOneOf<Command, CancelExport>) export_stop_.request_stop();
          // One that was not stopped also stops the export that is running.
          if (kIsOneOf<Command, ExportDataset, ExportProject, RenderPicture> && export_stop_.stop_requested())
            export_stop_ = std::stop_source();
          // A user's edits of the running scan are executed before it ends; exports, stopped above, are
          // only answered.
          if (kEndsScan<Command>) {
            std::erase_if(queue_,
                          [](const ScanCommand& one) { return !is<EditRegions>(one) && !isExport(one); });
          }
          if (kIsOneOf<Command, StopScan>) std::erase_if(queue_, is<StartScan>);
          if (kNewestReplaces<Command>) std::erase_if(queue_, is<Command>);
        },
        command);
    queue_.push_back(std::move(command));
  }
  changed_.notify_all();
}

void ScanWorker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !is_running_ && !isPosted<StartScan>(); });
}

template <class Command>
bool ScanWorker::isPosted() const {
  return std::ranges::any_of(queue_, is<Command>);
}

std::optional<ScanCommand> ScanWorker::take() {
  const std::scoped_lock lock(mutex_);
  if (queue_.empty() || is<StartScan>(queue_.front())) return std::nullopt;
  ScanCommand command = std::move(queue_.front());
  queue_.pop_front();
  return command;
}

std::optional<ScanCommand> ScanWorker::awaitCommand() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !queue_.empty(); });
  }
  return take();
}

void ScanWorker::loop(const std::stop_token& token) {
  for (;;) {
    ScanCommand command;
    {
      std::unique_lock lock(mutex_);
      is_running_ = false;
      changed_.notify_all();
      changed_.wait(lock, [&] { return token.stop_requested() || !queue_.empty(); });
      if (queue_.empty()) return;
      command = std::move(queue_.front());
      queue_.pop_front();
      is_running_ = is<StartScan>(command);
    }
    if (const auto* start = std::get_if<StartScan>(&command)) {
      run(start->request);
    } else if (const Result<void> done = execute(command, {}); !done) {
      spdlog::warn("{}", done.error().message());
    }
  }
}

Result<void> ScanWorker::execute(const ScanCommand& command, Target target) {
  Result<void> outcome;
  const auto with_review = [&](auto&& work) {
    if (target.review != nullptr) outcome = work(*target.review);
  };
  const auto with_export = [&](auto&& work) {
    if (target.review != nullptr) return work(*target.review);
    listener_(ExportFailed{{"A running scan cannot be exported.", "Stop the scan first."}});
  };
  const auto with_stop = [&](const auto& job) {
    const std::stop_token stop = exportStop();
    if (stop.stop_requested())
      return listener_(ExportFailed{{"The export was cancelled; nothing was written.", ""}});
    with_export([&](ScanReview& review) { review.execute(job, stop); });
  };
  std::visit(Overloaded{
                 [](const StartScan&) { /* loop() does it */ },
                 [&](PauseScan) { control_.is_paused = true; },
                 [&](ResumeScan) { control_.is_paused = false; },
                 [&](StepScan) { ++control_.steps; },
                 [&](StopScan) { control_.is_stopped = true; },
                 [&](CloseScan) { control_.is_closed = true; },
                 [&](SkipRefinement) { control_.skips_refinement = true; },
                 [&](const EditRegions& c) {
                   changes_.regions = true;
                   if (target.run != nullptr) return target.run->edit(c.edit);
                   if (target.review == nullptr) listener_(EditFailed{c.edit, {"That scan is closed.", ""}});
                   with_review([&](ScanReview& review) { return review.edit(c.edit); });
                 },
                 [&](ShowKeyFrame c) {
                   with_review([&](ScanReview& review) { return review.showKeyFrame(c.index); });
                 },
                 [&](LabelKeyFrame c) {
                   if (target.review != nullptr) target.review->execute(c);
                 },
                 [&](const PreviewExport& c) { with_export([&](ScanReview& review) { review.execute(c); }); },
                 [&](const SampleExport& c) { with_export([&](ScanReview& review) { review.execute(c); }); },
                 [&](const ExportDataset& c) { with_stop(c); },
                 [&](const ExportProject& c) { with_stop(c); },
                 [&](const RenderPicture& c) {
                   const std::stop_token stop = exportStop();
                   if (stop.stop_requested())
                     return listener_(RenderFailed{{"The picture was cancelled.", ""}});
                   if (target.review != nullptr) return target.review->execute(c, stop);
                   listener_(RenderFailed{{"A running scan cannot be drawn.", "Stop the scan first."}});
                 },
                 [](CancelExport) { /* post() has done it */ },
                 [&](ApplyCatalogueChanges) { changes_.catalogue = true; },
                 [&](const SetParams& c) {
                   changes_.params = true;
                   params_ = c.params;
                   if (target.run != nullptr) target.run->setParams(c.params);
                   with_review([&](ScanReview& review) { return review.setParams(c.params); });
                 },
             },
             command);
  return outcome;
}

std::stop_token ScanWorker::exportStop() {
  const std::scoped_lock lock(mutex_);
  return export_stop_.get_token();
}

void ScanWorker::run(const ScanRequest& request) {
  control_ = {.is_paused = request.start_paused, .skips_refinement = request.skip_refinement};
  params_ = request.params;
  const bool is_scan = request.refine_session || !request.source.empty();
  const bool has_session = !is_scan || runScan(request);
  if (has_session && request.review && request.output_folder) review(request, is_scan);
}

void ScanWorker::enter(ScanState next) {
  if (state_ == next) return;
  SCANTROVE_CHECK(canChange(state_, next));
  state_ = next;
  listener_(StateChanged{next});
}

void ScanWorker::failWith(const Error& error) {
  listener_(ScanFailed{error});
  enter(ScanState::failed);
}

bool ScanWorker::isEnding() {
  const std::scoped_lock lock(mutex_);
  return control_.is_stopped || control_.is_closed || (!queue_.empty() && is<StartScan>(queue_.front()));
}

/// Closing the program or starting another scan does not wait for work that can be done later.
bool ScanWorker::isRefinementSkipped() {
  const std::scoped_lock lock(mutex_);
  return control_.skips_refinement || control_.is_closed || isPosted<SkipRefinement>() ||
         isPosted<CloseScan>() || isPosted<StartScan>();
}

bool ScanWorker::runScan(const ScanRequest& request) {
  enter(ScanState::starting);
  ScanRequest cancellable = request;
  cancellable.source_options.on_opening = [this](double) {
    const std::scoped_lock lock(mutex_);
    return !isPosted<StopScan>() && !isPosted<CloseScan>() && !isPosted<StartScan>();
  };
  Result<std::unique_ptr<ScanRun>> run = guarded("preparing the scan", [&] {
    return ScanRun::open(cancellable, listener_, snapshots_, [this] { post(ApplyCatalogueChanges{}); });
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
  // The scanned part is stored even if the scan was interrupted.
  Result<ScanReport> report = guarded("ending the scan", [&] {
    return (*run)->finish({[this] { return !isRefinementSkipped(); }, [this](ScanState now) { enter(now); }});
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

Result<void> ScanWorker::scanFrames(ScanRun& run) {
  for (;;) {
    SCANTROVE_TRY(awaitTurn(run));
    changes_ = {};
    while (const std::optional<ScanCommand> command = take()) SCANTROVE_TRY(execute(*command, {.run = &run}));
    if (isEnding()) return {};
    const bool is_paused = control_.is_paused;
    if (is_paused && control_.steps == 0) {
      SCANTROVE_TRY(showPaused(run));
      continue;
    }
    if (control_.steps > 0) --control_.steps;
    // A user sees an edit before the next frame is processed.
    if (changes_.regions && !is_paused && run.hasFrames())
      SCANTROVE_TRY(run.showWhenDue(ScanState::scanning));
    enter(is_paused ? ScanState::paused : ScanState::scanning);
    run.startClock();
    Result<ScanRun::Step> step = run.step();
    if (!step) return fail(step.error());
    if (*step == ScanRun::Step::end) return {};
    if (is_paused) {
      if (*step == ScanRun::Step::nothing_yet) ++control_.steps;  // a step is one real frame
      run.stopClock();
      SCANTROVE_TRY(run.showNow(ScanState::paused));
    } else if (*step == ScanRun::Step::frame) {
      SCANTROVE_TRY(run.showWhenDue(ScanState::scanning));
    }
  }
}

Result<void> ScanWorker::awaitTurn(ScanRun& run) {
  const auto has_turn = [this] { return !control_.is_paused || control_.steps > 0 || !queue_.empty(); };
  std::unique_lock lock(mutex_);
  if (has_turn()) return {};
  lock.unlock();
  run.stopClock();
  if (state_ != ScanState::paused) {
    if (run.hasFrames()) SCANTROVE_TRY(run.showNow(ScanState::paused));
    enter(ScanState::paused);
  }
  lock.lock();
  changed_.wait(lock, has_turn);
  return {};
}

/// Shows the changes by commands to the frame at which a scan is paused.
Result<void> ScanWorker::showPaused(ScanRun& run) {
  const bool is_changed = changes_.catalogue && run.applyCatalogueChanges();
  if (!run.hasFrames()) return {};
  if (changes_.params) SCANTROVE_TRY(run.segmentAgain());
  if (!is_changed && !changes_.params && !changes_.regions) return {};
  return run.showNow(ScanState::paused);
}

void ScanWorker::review(const ScanRequest& request, bool is_after_scan) {
  {
    const std::scoped_lock lock(mutex_);
    const bool is_ending = isPosted<CloseScan>() || isPosted<StartScan>();
    const auto next = std::ranges::find_if_not(queue_, isExport);
    if (control_.is_closed || (is_ending && !is<EditRegions>(*next))) return;
    is_running_ = !is_after_scan;  // waiting for the scan does not include this
  }
  changed_.notify_all();
  if (!is_after_scan) enter(ScanState::starting);
  const Result<std::unique_ptr<ScanReview>> opened = guarded(
      "opening the session", [&] { return ScanReview::open(request, params_, listener_, snapshots_); });
  if (!opened) return failWith(opened.error());
  ScanReview& review = **opened;
  FirstError outcome;
  outcome.note(guarded("showing the session", [&] { return review.showAll(); }));
  if (!is_after_scan) enter(ScanState::finished);
  {
    const std::scoped_lock lock(mutex_);
    is_running_ = false;
  }
  changed_.notify_all();
  listener_(ReviewOpened{review.canBeRefined()});
  while (outcome.result()) {
    const std::optional<ScanCommand> command = awaitCommand();
    if (!command) return;
    outcome.note(guarded("working on the session", [&] { return execute(*command, {.review = &review}); }));
    if (control_.is_closed) return;
  }
  failWith(outcome.result().error());
}

}  // namespace scantrove
