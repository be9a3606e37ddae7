#pragma once
#include <QWidget>

#include "core/scan/scan_snapshot.h"

class QLabel;

namespace scantrove {

class ElidedLabel;

/// One line about the running scan: tracking state, speed, map size and lost frames. The tooltip has all
/// stage times.
class StatusStrip : public QWidget {
  Q_OBJECT

 public:
  explicit StatusStrip(QWidget* parent = nullptr);

  void showState(ScanState state);
  void showRefinement(int key_frame, int key_frames);
  void showPreparing();  ///< until the first snapshot
  void showSnapshot(const ScanSnapshot& snapshot);
  [[nodiscard]] QString stateText() const;

 private:
  void clear();
  void paintState();
  void clearSpeed();
  void showSpeed(const ScanSnapshot& snapshot);

  ScanState state_ = ScanState::idle;
  TrackingState tracking_ = TrackingState::lost;
  bool has_pose_ = false;
  bool is_preparing_ = false;
  QString refinement_;  // progress text
  QLabel* state_label_;
  QLabel* speed_;
  ElidedLabel* stages_;
  QLabel* map_;
  QLabel* losses_;
};

/// Text of a state, for example "Scanning".
[[nodiscard]] QString stateInWords(ScanState state);

}  // namespace scantrove
