#pragma once
#include <QElapsedTimer>
#include <QString>
#include <QWidget>

#include "core/scan/scan_event.h"
#include "core/scan/scan_snapshot.h"

class QLabel;
class QAction;
class QProgressBar;
class QToolButton;

namespace scantrove {

class ElidedLabel;

/// Source and progress of the scan: frames of a recording, elapsed time of a camera, or key frames of the
/// refinement with a button to skip it.
class ProgressStrip : public QWidget {
  Q_OBJECT

 public:
  /// `skip`: ends the refinement.
  explicit ProgressStrip(QAction* skip, QWidget* parent = nullptr);
  void begin(const QString& title);
  void showSnapshot(const ScanSnapshot& snapshot);
  void showState(ScanState state);
  void showRefinement(const RefinementStepped& progress);
  void clear();
  [[nodiscard]] QString text() const;

 private:
  void setCount(const QString& text);

  ElidedLabel* title_;
  QProgressBar* bar_;
  QLabel* count_;
  QToolButton* skip_;  ///< visible during the refinement only
  bool is_refining_ = false;
  QElapsedTimer since_start_;
};

}  // namespace scantrove
