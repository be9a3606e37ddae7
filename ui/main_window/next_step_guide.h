#pragma once
#include <QObject>

#include "ui/models/next_steps.h"

namespace scantrove {

class MainWindow;

/// Counts what is left to do in the open scan, shows it in the strip, and does a step on request.
class NextStepGuide : public QObject {
  Q_OBJECT

 public:
  /// Call after the window's parts were created.
  explicit NextStepGuide(MainWindow& window);

 private:
  void end();
  void update();
  void perform(NextStep::Kind step);
  /// Selects the largest region without a name, and its object in the list, which gets the focus.
  void goToUnnamed();

  MainWindow& window_;
  bool is_open_ = false;  ///< a scan is open for review
};

}  // namespace scantrove
