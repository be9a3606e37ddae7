#include "ui/bridge/scan_bridge.h"

namespace scantrove {
namespace {

constexpr int kInterval_ms = 66;

bool isStarting(const ScanEvent& event) {
  const auto* changed = std::get_if<StateChanged>(&event);
  return changed != nullptr && changed->state == ScanState::starting;
}

}  // namespace

ScanBridge::ScanBridge(const ScanPortFactory& factory, QObject* parent) : QObject(parent) {
  port_ = factory([this](const ScanEvent& event) { receive(event); });
  timer_.setInterval(kInterval_ms);
  connect(&timer_, &QTimer::timeout, this, &ScanBridge::deliver);
  timer_.start();
}

ScanBridge::~ScanBridge() {
  ScanPort ending;
  {
    const std::scoped_lock lock(mutex_);
    ending = std::exchange(port_, {});
  }
  ending = {};  // the worker's thread still calls receive()
}

void ScanBridge::receive(const ScanEvent& event) {
  const std::scoped_lock lock(mutex_);
  // A snapshot still in the mailbox belongs to the previous scan and must not be delivered after this event.
  if (isStarting(event) && port_.snapshots != nullptr) static_cast<void>(port_.snapshots->collect());
  queue_.push_back(event);
}

void ScanBridge::deliver() {
  std::vector<ScanEvent> events;
  std::shared_ptr<const ScanSnapshot> snapshot;
  {
    const std::scoped_lock lock(mutex_);
    snapshot = port_.snapshots->collect();
    events = std::exchange(queue_, {});
  }
  // A snapshot collected together with `starting` was posted after it (see receive).
  for (const ScanEvent& event : events) {
    if (const auto* changed = std::get_if<StateChanged>(&event)) state_ = changed->state;
    emit eventArrived(event);
  }
  if (snapshot != nullptr) emit snapshotArrived(snapshot);
}

}  // namespace scantrove
