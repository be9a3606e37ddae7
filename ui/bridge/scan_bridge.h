#pragma once
#include <QObject>
#include <QTimer>
#include <concepts>
#include <memory>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "ui/bridge/scan_port.h"

namespace scantrove {

/// Carries commands to the worker of scans, and its events and snapshots to the window's thread. Events wait
/// in a queue and none is lost; of the snapshots only the newest is collected, about 15 times a second. They
/// come in order: a snapshot after all events that happened before it, and no snapshot of an earlier scan
/// after `starting`. All of it is for the window's thread.
class ScanBridge : public QObject {
  Q_OBJECT

 public:
  explicit ScanBridge(const ScanPortFactory& factory, QObject* parent = nullptr);
  ~ScanBridge() override;  ///< the scan has ended then

  void post(ScanCommand command) { port_.post(std::move(command)); }

  /// Calls `handler` with each event of this type from now on, while `context` lives.
  template <class Event, class Handler>
  QMetaObject::Connection on(QObject* context, Handler handler) {
    return connect(this, &ScanBridge::eventArrived, context, [handler](const ScanEvent& event) {
      const auto* const one = std::get_if<Event>(&event);
      if (one == nullptr) return;
      if constexpr (std::invocable<Handler, const Event&>) {
        handler(*one);
      } else {
        handler();
      }
    });
  }

  /// The last state that was delivered, not the one the worker may be in by now.
  [[nodiscard]] ScanState state() const { return state_; }
  /// A scan runs or is about to: it can be stopped.
  [[nodiscard]] bool busy() const { return isBusy(state_); }

 signals:
  void snapshotArrived(const std::shared_ptr<const scantrove::ScanSnapshot>& snapshot);
  void eventArrived(const scantrove::ScanEvent& event);

 private:
  void receive(const ScanEvent& event);  ///< on the worker's thread
  void deliver();

  std::mutex mutex_;
  std::vector<ScanEvent> queue_;  ///< guarded by mutex_
  ScanState state_ = ScanState::idle;
  QTimer timer_;
  ScanPort port_;
};

}  // namespace scantrove
