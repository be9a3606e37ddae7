#pragma once
#include <QObject>
#include <memory>

#include "core/scan/scan_event.h"
#include "core/scan/scan_snapshot.h"
#include "ui/main_window/window_parts.h"

namespace scantrove {

class MainWindow;

/// Shows state, snapshots and failures of the current scan in the parts of the window.
class ScanDisplay : public QObject {
  Q_OBJECT

 public:
  /// Call after the window's parts were created.
  explicit ScanDisplay(MainWindow& window);

 private:
  void begin(const QString& source);
  void showSnapshot(const std::shared_ptr<const ScanSnapshot>& collected);
  void showState(ScanState state);
  void showAdvice(const ScanAdvice& advice);
  void scanFailed(const ScanFailed& event);

  MainWindow& window_;
  const WindowParts parts_;
  bool has_snapshot_ = false;  ///< of the current scan
};

}  // namespace scantrove
