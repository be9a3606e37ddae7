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

/// Passes commands to the scan worker, and its events and snapshots to the window's thread. All events are
/// delivered; of the snapshots only the newest, about 15 times a second. A snapshot is delivered after all
/// events that happened before it. No snapshot of an earlier scan is delivered after `starting`. Use from the
/// window's thread only.
class ScanBridge : public QObject {
  Q_OBJECT

 public:
  explicit ScanBridge(const ScanPortFactory& factory, QObject* parent = nullptr);
  ~ScanBridge() override;  ///< waits for the end of the scan

  void post(ScanCommand command) { port_.post(std::move(command)); }

  /// Calls `handler` with each event of this type while `context` lives.
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

  /// The last delivered state; the worker may be in a later one.
  [[nodiscard]] ScanState state() const { return state_; }
  /// A scan runs or is starting; it can be stopped.
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
