// What is done to the regions, and how it is taken back.
#include <QFuture>
#include <QPromise>
#include <QThreadPool>
#include <QUndoCommand>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "ui/main_window/region_controller.h"
#include "ui/main_window/scene_pane.h"

namespace scantrove {
namespace {

constexpr std::size_t kVoxelsToPropose = 150;  ///< smaller ones have no look

RegionProposals::Looks looksOf(const std::map<RegionId, std::vector<LookPoint>>& points) {
  RegionProposals::Looks looks;
  for (const auto& [region, of_region] : points) looks[region] = lookOf(of_region);
  return looks;
}

}  // namespace

/// An operation on the undo stack. The scan's own log is what is taken back and done again.
class RegionController::Command : public QUndoCommand {
 public:
  /// `is_done`: by the scan, before this window knew of it.
  Command(RegionController& controller, const QString& text, Operation operation, bool is_done)
      : QUndoCommand(text), controller_(controller), operation_(std::move(operation)), is_done_(is_done) {}

  void redo() override {
    if (!controller_.is_telling_ || has_failed_) return;
    if (std::exchange(is_done_, true)) {
      controller_.bridge_.edit(RedoEdit{});
    } else {
      controller_.bridge_.edit(operation_);
    }
  }
  void undo() override {
    if (has_failed_) {
      setObsolete(true);
    } else if (controller_.is_telling_) {
      controller_.bridge_.edit(UndoEdit{});
    }
  }

  [[nodiscard]] bool is(const Operation& operation) const { return operation == operation_; }
  /// There is nothing to take back.
  void noteFailure() const { has_failed_ = true; }

 private:
  RegionController& controller_;
  Operation operation_;
  bool is_done_;
  mutable bool has_failed_ = false;
};

void RegionController::doOnAll(OperationKind kind, bool on) {
  if (selection_.selected().empty()) return;
  Operation operation;
  operation.kind = kind;
  operation.regions = selection_.selected();
  operation.on = on;
  perform(std::move(operation));
}

void RegionController::doOnEach(OperationKind kind) {
  for (const RegionId region : std::vector(selection_.selected())) {
    Operation operation;
    operation.kind = kind;
    operation.regions = {region};
    perform(std::move(operation));
  }
}

void RegionController::perform(Operation operation) {
  const QString text = inWords(operation);
  undo_.push(new Command(*this, text, std::move(operation), false));
}

void RegionController::learnHistory(const std::vector<DoneOperation>& operations) {
  is_telling_ = false;
  int done = 0;
  for (const DoneOperation& operation : operations) {
    if (operation.state == OperationLog::State::superseded) continue;
    Operation words;
    words.kind = operation.kind;
    words.regions = operation.regions;
    words.name = operation.name;
    words.on = operation.on;
    const QString text = inWords(words);
    undo_.push(new Command(*this, text, std::move(words), true));
    if (operation.state == OperationLog::State::done) ++done;
  }
  undo_.setIndex(done);
  is_telling_ = true;
}

void RegionController::edited(const ScanEdit& edit, const std::vector<RegionId>& regions) {
  if (std::holds_alternative<UndoEdit>(edit)) {
    // The question was about a name that may be gone.
    ++proposal_number_;
    proposals_.withdraw();
  }
  const auto* operation = std::get_if<Operation>(&edit);
  if (operation == nullptr) return;
  switch (operation->kind) {
    case OperationKind::name:
      proposeLike(*operation);
      break;
    case OperationKind::join:
    case OperationKind::cut:
    case OperationKind::finer:
    case OperationKind::coarser:
      if (!regions.empty()) selection_.select(regions);
      break;
    default:
      break;
  }
}

void RegionController::editFailed(const ScanEdit& edit, const QString& message) {
  emit failed(message);
  cutter_->end();
  const auto* const operation = std::get_if<Operation>(&edit);
  for (int i = undo_.count() - 1; operation != nullptr && i >= 0; --i) {
    const auto* const command = dynamic_cast<const Command*>(undo_.command(i));
    if (command == nullptr || !command->is(*operation)) continue;
    command->noteFailure();
    if (i + 1 == undo_.count() && i + 1 == undo_.index()) undo_.undo();
    return;
  }
}

QString RegionController::inWords(const Operation& operation) const {
  QString what = operation.regions.size() == 1
                     ? selection_.title(operation.regions.front())
                     : tr("%n regions", nullptr, static_cast<int>(operation.regions.size()));
  switch (operation.kind) {
    case OperationKind::name:
    case OperationKind::accept:
      return operation.name.empty() ? tr("Take the name of %1 away").arg(what)
                                    : tr("Name %1 “%2”").arg(what, QString::fromStdString(operation.name));
    case OperationKind::join:
      return tr("Join %1").arg(what);
    case OperationKind::cut:
      return tr("Cut %1").arg(what);
    case OperationKind::finer:
      return tr("%1 finer").arg(what);
    case OperationKind::coarser:
      return tr("%1 coarser").arg(what);
    case OperationKind::background:
      return operation.on ? tr("%1: background").arg(what) : tr("%1: no background").arg(what);
    case OperationKind::object:
      return tr("%1: an object").arg(what);
    case OperationKind::reject:
      return operation.on ? tr("%1: not an object").arg(what) : tr("%1: not rejected").arg(what);
  }
  return what;
}

void RegionController::proposeLike(const Operation& naming) {
  if (naming.name.empty() || naming.regions.empty()) return;
  auto points = scene_.view()->scene().cloud().pointsOfRegions(kVoxelsToPropose);
  std::erase_if(points, [&](const auto& entry) {
    const RegionInfo* const info = selection_.info(entry.first);
    const bool is_named = entry.first == naming.regions.front();
    return info == nullptr ||
           (!is_named && (info->note.background || info->note.rejected || !info->note.name.empty()));
  });
  // In a large scan that takes a while, and nobody waits for it.
  const auto promise = std::make_shared<QPromise<RegionProposals::Looks>>();
  promise->start();
  QThreadPool::globalInstance()->start([promise, of_region = std::move(points)] {
    promise->addResult(looksOf(of_region));
    promise->finish();
  });
  const int number = ++proposal_number_;
  promise->future().then(this, [this, naming, number](const RegionProposals::Looks& looks) {
    if (number != proposal_number_) return;  // something else was named meanwhile, or another scan begun
    proposals_.propose(naming.regions.front(), QString::fromStdString(naming.name),
                       QString::fromStdString(naming.category), looks);
  });
}

void RegionController::accept(const std::vector<Proposal>& accepted) {
  for (const Proposal& proposal : accepted) {
    Operation operation;
    operation.kind = OperationKind::accept;
    operation.regions = {proposal.region};
    operation.name = proposal.name.toStdString();
    operation.category = proposal.category.toStdString();
    perform(std::move(operation));
  }
}

}  // namespace scantrove
