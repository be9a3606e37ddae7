#include "ui/main_window/region_operations.h"

#include <QFuture>
#include <QMessageBox>
#include <QPromise>
#include <QPushButton>
#include <QThreadPool>
#include <QUndoCommand>
#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "ui/main_window/scene_pane.h"

namespace scantrove {
namespace {

constexpr std::size_t kVoxelsToPropose = 150;  ///< minimum size for a usable appearance

RegionProposals::Appearances appearancesOf(const std::map<RegionId, std::vector<AppearancePoint>>& points) {
  RegionProposals::Appearances appearances;
  for (const auto& [region, of_region] : points) appearances[region] = appearanceOf(of_region);
  return appearances;
}

}  // namespace

/// An operation as undo step. Undo and redo use the scan's operation log.
class RegionOperations::Command : public QUndoCommand {
 public:
  /// `is_done`: already done by the scan.
  Command(RegionOperations& operations, const QString& text, Operation operation, bool is_done)
      : QUndoCommand(text), operations_(operations), operation_(std::move(operation)), is_done_(is_done) {}

  void redo() override {
    operations_.bridge_.post(EditRegions{std::exchange(is_done_, true) ? ScanEdit(RedoEdit{}) : operation_});
  }
  void undo() override { operations_.bridge_.post(EditRegions{UndoEdit{}}); }

  [[nodiscard]] bool is(const Operation& operation) const { return operation == operation_; }

 private:
  RegionOperations& operations_;
  Operation operation_;
  bool is_done_;
};

RegionOperations::RegionOperations(ScanBridge& bridge, ScenePane& scene, RegionSelection& selection,
                                   UndoHistory& history, QWidget& window)
    : bridge_(bridge), scene_(scene), selection_(selection), history_(history), window_(window) {
  bridge_.on<Edited>(this, [this](const Edited& event) { edited(event); });
  bridge_.on<EditFailed>(this, [this](const EditFailed& event) { editFailed(event); });
}

RegionOperations::~RegionOperations() = default;

void RegionOperations::beginScan() {
  ++proposal_number_;
  proposals_.clear();
  delete confirmation_;
  performed_.clear();
  history_.forget(this);
  knows_history_ = false;
}

void RegionOperations::showSnapshot(const ScanSnapshot& snapshot) {
  if (snapshot.operations != nullptr && !std::exchange(knows_history_, true))
    updateHistory(*snapshot.operations);
}

void RegionOperations::undoNewest() { history_.undoNewest(this); }

void RegionOperations::acceptFirst() { accept(proposals_.acceptFirst()); }
void RegionOperations::acceptAll() { accept(proposals_.acceptAll()); }

void RegionOperations::name(const std::vector<RegionName>& names) {
  std::vector<RegionId> regions;
  for (const RegionName& name : names) regions.push_back(name.region);
  const auto nameAll = [this, names] {
    for (const RegionName& name : names) nameRegion(OperationKind::name, name);
  };
  const std::vector<RegionId> background = backgroundAmong(regions);
  if (background.empty() || names.front().given.name.empty()) return nameAll();
  const auto named = std::ranges::find(names, background.front(), &RegionName::region);
  confirm(tr("%1 is background, which data sets omit. Make it an object with the name “%2”?")
              .arg(selection_.title(background.front()), QString::fromStdString(named->given.name)),
          tr("Make it an object"), [this, background, nameAll] {
            Operation operation;
            operation.kind = OperationKind::background;
            operation.regions = background;
            operation.on = false;
            perform(std::move(operation));
            nameAll();
          });
}

void RegionOperations::nameRegion(OperationKind kind, const RegionName& name) {
  Operation operation;
  operation.kind = kind;
  operation.regions = {name.region};
  operation.name = name.given.name;
  operation.category = name.given.class_name;
  perform(std::move(operation));
  if (!name.given.name.empty()) emit nameGiven(name);
}

void RegionOperations::applyToAll(OperationKind kind, bool on) {
  if (selection_.selected().empty()) return;
  Operation operation;
  operation.kind = kind;
  operation.regions = selection_.selected();
  operation.on = on;
  perform(std::move(operation));
}

void RegionOperations::markSupports() {
  Operation operation;
  operation.kind = OperationKind::background;
  operation.regions = selection_.proposedBackground();
  if (!operation.regions.empty()) perform(std::move(operation));
}

void RegionOperations::join() {
  std::vector<RegionId> regions = selection_.selected();
  if (regions.size() < 2) {
    emit hinted(tr("Select the regions to join: click one, then Ctrl+click the others."));
    return;
  }
  std::stable_partition(regions.begin(), regions.end(), [this](RegionId region) {
    const RegionInfo* const info = selection_.info(region);
    return info != nullptr && !info->note.name.empty();
  });
  const auto joinAll = [this, regions] {
    Operation operation;
    operation.kind = OperationKind::join;
    operation.regions = regions;
    perform(std::move(operation));
  };
  const std::vector<RegionId> background = backgroundAmong(regions);
  if (background.empty() || background.size() == regions.size()) return joinAll();
  confirm(tr("%1 is background. Join what is selected with it?").arg(selection_.title(background.front())),
          tr("Join"), joinAll);
}

std::vector<RegionId> RegionOperations::backgroundAmong(const std::vector<RegionId>& regions) const {
  std::vector<RegionId> background;
  std::ranges::copy_if(regions, std::back_inserter(background), [this](RegionId region) {
    const RegionInfo* const info = selection_.info(region);
    return info != nullptr && info->note.background;
  });
  return background;
}

void RegionOperations::confirm(const QString& question, const QString& yes, std::function<void()> action) {
  delete confirmation_;
  confirmation_ =
      new QMessageBox(QMessageBox::Question, tr("Background"), question, QMessageBox::Cancel, &window_);
  confirmation_->setObjectName(QStringLiteral("backgroundQuestion"));
  confirmation_->setAttribute(Qt::WA_DeleteOnClose);
  confirmation_->setTextFormat(Qt::PlainText);
  const QPushButton* const button = confirmation_->addButton(yes, QMessageBox::AcceptRole);
  confirmation_->setDefaultButton(QMessageBox::Cancel);
  connect(button, &QPushButton::clicked, this, [action = std::move(action)] { action(); });
  confirmation_->open();
}

void RegionOperations::applyToEach(OperationKind kind) {
  for (const RegionId region : std::vector(selection_.selected())) {
    Operation operation;
    operation.kind = kind;
    operation.regions = {region};
    perform(std::move(operation));
  }
}

void RegionOperations::perform(Operation operation) {
  const QString text = descriptionOf(operation);
  performed_.push_back(std::make_shared<Command>(*this, text, std::move(operation), false));
  history_.push(this, performed_.back());
}

void RegionOperations::updateHistory(const std::vector<DoneOperation>& operations) {
  std::vector<UndoHistory::Step> steps;
  std::size_t done = 0;
  const auto names = [](const DoneOperation& operation) {
    return operation.kind == OperationKind::name || operation.kind == OperationKind::accept;
  };
  // Steps say what a region was called then. Without a name so far it gets none that it got later.
  std::map<RegionId, QString> titles;
  for (const DoneOperation& operation : operations) {
    if (!names(operation)) continue;
    for (const RegionId region : operation.regions)
      titles[region] = RegionSelection::titleWithoutName(region);
  }
  for (const DoneOperation& operation : operations) {
    if (operation.state == OperationLog::State::superseded) continue;
    Operation described;
    described.kind = operation.kind;
    described.regions = operation.regions;
    described.name = operation.name;
    described.on = operation.on;
    described.review = operation.review;
    QString title;
    if (operation.regions.size() == 1) {
      const auto then = titles.find(operation.regions.front());
      if (then != titles.end()) title = then->second;
    }
    const QString text = descriptionOf(described, title);
    if (names(operation)) {
      for (const RegionId region : operation.regions) {
        titles[region] = operation.name.empty() ? RegionSelection::titleWithoutName(region)
                                                : QString::fromStdString(operation.name);
      }
    }
    steps.push_back(std::make_shared<Command>(*this, text, std::move(described), true));
    if (operation.state == OperationLog::State::done) ++done;
  }
  history_.prepend(this, steps, done);
}

void RegionOperations::edited(const Edited& event) {
  if (std::holds_alternative<UndoEdit>(event.edit)) {
    // The suggestions are for a name that may be undone.
    ++proposal_number_;
    proposals_.withdraw();
  }
  const auto* operation = std::get_if<Operation>(&event.edit);
  if (operation == nullptr) return;
  if (event.is_automatic) return addStep(*operation);
  switch (operation->kind) {
    case OperationKind::name:
      proposeSimilar(*operation);
      break;
    case OperationKind::join:
    case OperationKind::cut:
    case OperationKind::finer:
    case OperationKind::coarser:
      if (!event.regions.empty()) selection_.select(event.regions);
      break;
    case OperationKind::paint: {
      const bool is_new = operation->correction && operation->correction->makes_region;
      if (is_new && !event.regions.empty()) selection_.select(event.regions.front());
      break;
    }
    default:
      break;
  }
}

void RegionOperations::addStep(const Operation& operation) {
  if (!knows_history_) return;  // of an earlier scan, or the history to come includes it
  history_.append(this, std::make_shared<Command>(*this, descriptionOf(operation), operation, true));
}

void RegionOperations::editFailed(const EditFailed& event) {
  const QString message = QString::fromStdString(event.error.message());
  const auto* const operation = std::get_if<Operation>(&event.edit);
  const bool is_split = operation != nullptr && operation->kind == OperationKind::cut;
  if (is_split)
    emit splitFailed(message);
  else
    emit failed(message);
  const auto failed = std::find_if(performed_.rbegin(), performed_.rend(), [operation](const auto& command) {
    return operation != nullptr && command->is(*operation);
  });
  if (failed == performed_.rend()) return;
  history_.forget(**failed);
  performed_.erase(std::next(failed).base());
}

QString RegionOperations::descriptionOf(const Operation& operation, const QString& title) const {
  if (operation.review) return descriptionOf(*operation.review);
  QString what = title;
  if (what.isEmpty()) {
    what = operation.regions.size() == 1
               ? selection_.title(operation.regions.front())
               : tr("%n regions", nullptr, static_cast<int>(operation.regions.size()));
  }
  switch (operation.kind) {
    case OperationKind::name:
    case OperationKind::accept:
      return operation.name.empty() ? tr("Remove the name of %1").arg(what)
                                    : tr("Name %1 “%2”").arg(what, QString::fromStdString(operation.name));
    case OperationKind::join:
      return tr("Join %1").arg(what);
    case OperationKind::cut:
      return tr("Split %1").arg(what);
    case OperationKind::finer:
      return tr("Split %1 further").arg(what);
    case OperationKind::coarser:
      return tr("Merge %1 with its neighbour").arg(what);
    case OperationKind::background:
      return operation.on ? tr("%1: background").arg(what) : tr("%1: not background").arg(what);
    case OperationKind::object:
      return tr("%1: an object").arg(what);
    case OperationKind::reject:
      return operation.on ? tr("%1: not an object").arg(what) : tr("%1: not rejected").arg(what);
    case OperationKind::paint:
      if (operation.correction && operation.correction->makes_region)
        return tr("Paint a new region in image %1").arg(operation.correction->image);
      // A reopened scan does not tell the image.
      if (!operation.correction) return tr("Correct mask of %1").arg(what);
      return tr("Correct mask of %1 in image %2").arg(what, QString::number(operation.correction->image));
    case OperationKind::unpaint:
      if (!operation.correction) return tr("Reset mask of %1").arg(what);
      return tr("Reset mask of %1 in image %2").arg(what, QString::number(operation.correction->image));
    case OperationKind::review:
      break;
  }
  return what;
}

QString RegionOperations::descriptionOf(const FrameReview& review) {
  switch (review.state) {
    case ReviewState::open:
      return tr("Image %1: open").arg(review.image);
    case ReviewState::checked:
      return tr("Image %1: checked").arg(review.image);
    case ReviewState::left_out:
      return tr("Image %1: left out").arg(review.image);
  }
  return {};
}

void RegionOperations::proposeSimilar(const Operation& naming) {
  // An answer to a command of an earlier scan may arrive late.
  if (!knows_history_ || naming.name.empty() || naming.regions.empty()) return;
  auto points = scene_.view()->scene().cloud().pointsOfRegions(kVoxelsToPropose);
  std::erase_if(points, [&](const auto& entry) {
    const RegionInfo* const info = selection_.info(entry.first);
    const bool is_named = entry.first == naming.regions.front();
    return info == nullptr ||
           (!is_named && (info->note.background || info->note.rejected || !info->note.name.empty()));
  });
  // Slow for large scans, so it runs on another thread.
  const auto promise = std::make_shared<QPromise<RegionProposals::Appearances>>();
  promise->start();
  QThreadPool::globalInstance()->start([promise, of_region = std::move(points)] {
    promise->addResult(appearancesOf(of_region));
    promise->finish();
  });
  const int number = ++proposal_number_;
  promise->future().then(this, [this, naming, number](const RegionProposals::Appearances& appearances) {
    if (number != proposal_number_) return;  // another name or scan followed meanwhile
    proposals_.propose(naming.regions.front(), QString::fromStdString(naming.name),
                       QString::fromStdString(naming.category), appearances);
  });
}

void RegionOperations::accept(const std::vector<Proposal>& accepted) {
  for (const Proposal& proposal : accepted) {
    const GivenName given{proposal.name.toStdString(), proposal.category.toStdString()};
    nameRegion(OperationKind::accept,
               {proposal.region, other_name_ ? other_name_(proposal.region, given) : given});
  }
}

}  // namespace scantrove
