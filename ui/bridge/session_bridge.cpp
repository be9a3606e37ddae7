#include "ui/bridge/session_bridge.h"

#include "core/base/overloaded.h"

#include <utility>

namespace scantrove {
namespace {

constexpr int kInterval_ms = 66;

bool isStarting(const ScanEvent& event) {
  const auto* changed = std::get_if<StateChanged>(&event);
  return changed != nullptr && changed->state == ScanState::starting;
}

}  // namespace

SessionBridge::SessionBridge(const SessionFactory& factory, QObject* parent) : QObject(parent) {
  session_ = factory([this](const ScanEvent& event) { receive(event); });
  timer_.setInterval(kInterval_ms);
  connect(&timer_, &QTimer::timeout, this, &SessionBridge::deliver);
  timer_.start();
}

SessionBridge::~SessionBridge() = default;

void SessionBridge::start(const ScanRequest& request) { session_->start(request); }

bool SessionBridge::busy() const { return isBusy(state_); }

void SessionBridge::receive(const ScanEvent& event) {
  const std::scoped_lock lock(mutex_);
  // What is still in the mailbox belongs to the scan before: it must not reach the window after this event.
  if (isStarting(event) && session_ != nullptr) static_cast<void>(session_->snapshots().collect());
  queue_.push_back(event);
}

void SessionBridge::deliver() {
  std::vector<ScanEvent> events;
  std::shared_ptr<const ScanSnapshot> snapshot;
  {
    const std::scoped_lock lock(mutex_);
    snapshot = session_->snapshots().collect();
    events = std::exchange(queue_, {});
  }
  // A snapshot collected together with `starting` was posted after it (see receive).
  for (const ScanEvent& event : events) announce(event);
  if (snapshot != nullptr) emit snapshotArrived(snapshot);
}

void SessionBridge::announce(const ScanEvent& event) {
  std::visit(
      Overloaded{
          [this](const StateChanged& e) {
            state_ = e.state;
            emit stateChanged(e.state);
          },
          [this](const RefinementStepped& e) { emit refinementStepped(e); },
          [this](const PreparingDevice&) { emit preparingDevice(); },
          [this](const ObjectAdded& e) { emit objectAdded(e.object, QString::fromStdString(e.name)); },
          [this](const ObjectRecognized& e) {
            emit objectRecognized(e.object, QString::fromStdString(e.name));
          },
          [this](const ViewAdded& e) { emit viewAdded(e.object); },
          [this](const ObjectsMerged& e) { emit objectsMerged(e.into); },
          [](const ObjectLeft&) { /* the catalogue's panel sees it in the catalogue */ },
          [this](const ObjectNamed& e) { emit objectNamed(e.object); },
          [this](const CatalogueFailed& e) {
            emit catalogueFailed(QString::fromStdString(e.error.message()));
          },
          [this](const MapFailed& e) { emit mapFailed(QString::fromStdString(e.error.message())); },
          [this](const MapDrifted& e) { emit mapDrifted(QString::fromStdString(e.error.message())); },
          [this](const ScanAdvice& e) { emit scanAdvised(QString::fromStdString(e.error.message())); },
          [this](const Edited& e) { emit edited(e.edit, e.regions); },
          [this](const EditFailed& e) { emit editFailed(e.edit, QString::fromStdString(e.error.message())); },
          [this](const ReviewOpened& e) { emit reviewOpened(e.can_refine); },
          [this](const ExportPreviewed& e) { emit exportPreviewed(e.preview); },
          [this](const ExportSampled& e) { emit exportSampled(e.sample); },
          [this](const ExportStepped& e) { emit exportStepped(e.progress); },
          [this](const ExportFinished& e) { emit exportFinished(e.summary); },
          [this](const ExportFailed& e) { emit exportFailed(QString::fromStdString(e.error.message())); },
          [this](const FrameSkipped& e) {
            emit frameSkipped(e.frame_index, QString::fromStdString(e.error.message()));
          },
          [this](const ScanFailed& e) { emit scanFailed(QString::fromStdString(e.error.message())); },
          [this](const ScanFinished& e) { emit scanFinished(e.report); },
      },
      event);
}

}  // namespace scantrove
