#pragma once
#include <QAction>
#include <QList>
#include <QObject>

#include "core/base/review_state.h"

namespace scantrove {

class RegionOperations;
class TimeLine;

/// The actions that review key frames. Each review is a step of the window's undo history.
class ReviewController : public QObject {
  Q_OBJECT

 public:
  /// Both outlive it.
  ReviewController(TimeLine& time_line, RegionOperations& operations, QObject* parent);

  /// In menu order.
  [[nodiscard]] QList<QAction*> actions() const;
  [[nodiscard]] QAction* checkAction() const { return check_; }
  [[nodiscard]] QAction* leaveOutAction() const { return leave_out_; }
  [[nodiscard]] QAction* reopenAction() const { return reopen_; }
  void goToNextOpen() { go(1); }

 private:
  QAction* make(const QString& text, const QString& key, const QString& help);
  /// Sets the state of the shown key frame.
  void review(ReviewState state);
  /// To the next open key frame, or the previous one.
  void go(int step);
  void updateActions();

  TimeLine& time_line_;
  RegionOperations& operations_;
  QAction *check_, *leave_out_, *reopen_, *next_, *previous_;
};

}  // namespace scantrove
