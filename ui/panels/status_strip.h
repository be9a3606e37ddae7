#pragma once
#include <QWidget>

#include "core/scan/scan_snapshot.h"

class QLabel;

namespace scantrove {

class ElidedLabel;

/// One line about the running scan: is the camera tracked, how fast, how large the map, what was lost. The
/// stage times in full are in its tooltip.
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
  QString refinement_;  // how far it is
  QLabel* state_label_;
  QLabel* speed_;
  ElidedLabel* stages_;
  QLabel* map_;
  QLabel* losses_;
};

/// "scanning", "paused", ... in plain words.
[[nodiscard]] QString stateInWords(ScanState state);

}  // namespace scantrove
