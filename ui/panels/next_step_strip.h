#pragma once
#include <QFrame>
#include <vector>

#include "ui/models/next_steps.h"

class QHBoxLayout;

namespace scantrove {

/// Says what comes next after a scan: a button for each step. Hidden until there are steps, and after it was
/// closed until the next scan.
class NextStepStrip : public QFrame {
  Q_OBJECT

 public:
  explicit NextStepStrip(QWidget* parent = nullptr);
  void showSteps(const std::vector<NextStep>& steps);
  /// Hides it until the next showSteps(), also if it was closed.
  void beginScan();
  /// Texts of the buttons, in order.
  [[nodiscard]] QStringList texts() const;

 signals:
  void requested(scantrove::NextStep::Kind step);

 private:
  void addStep(const NextStep& step);
  void updateVisibility();

  QHBoxLayout* steps_row_;
  std::vector<NextStep> steps_;
  bool is_active_ = false, is_closed_ = false;
};

}  // namespace scantrove
