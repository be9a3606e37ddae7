#include "ui/panels/next_step_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/theme/icon.h"

namespace scantrove {

NextStepStrip::NextStepStrip(QWidget* parent) : QFrame(parent), steps_row_(new QHBoxLayout) {
  setObjectName(QStringLiteral("nextSteps"));
  setFrameShape(QFrame::StyledPanel);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 2, 6, 2);
  row->setSpacing(8);
  auto* title = new QLabel(tr("Next"));
  title->setProperty("muted", true);
  row->addWidget(title);
  steps_row_->setSpacing(6);
  row->addLayout(steps_row_);
  row->addStretch(1);
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("closeNextSteps"));
  close->setIcon(icon(QStringLiteral("close")));
  close->setAutoRaise(true);
  close->setToolTip(tr("Hide the next steps of this scan"));
  close->setAccessibleName(close->toolTip());
  connect(close, &QToolButton::clicked, this, [this] {
    is_closed_ = true;
    updateVisibility();
  });
  row->addWidget(close);
  hide();
}

void NextStepStrip::beginScan() {
  is_closed_ = false;
  is_active_ = false;
  updateVisibility();
}

void NextStepStrip::updateVisibility() { setVisible(is_active_ && !is_closed_ && !steps_.empty()); }

void NextStepStrip::showSteps(const std::vector<NextStep>& steps) {
  if (steps != steps_) {
    steps_ = steps;
    // A button may be in its own click, so it is deleted later.
    while (QLayoutItem* item = steps_row_->takeAt(0)) {
      item->widget()->hide();
      item->widget()->deleteLater();
      delete item;
    }
    for (const NextStep& step : steps_) addStep(step);
  }
  is_active_ = true;
  updateVisibility();
}

void NextStepStrip::addStep(const NextStep& step) {
  if (steps_row_->count() > 0) {
    auto* arrow = new QLabel(QStringLiteral("→"));
    arrow->setProperty("muted", true);
    steps_row_->addWidget(arrow);
  }
  auto* button = new QToolButton;
  button->setText(textOf(step));
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setFocusPolicy(Qt::TabFocus);
  QFont font = button->font();
  font.setWeight(step.is_next ? QFont::DemiBold : QFont::Normal);
  button->setFont(font);
  connect(button, &QToolButton::clicked, this, [this, kind = step.kind] { emit requested(kind); });
  steps_row_->addWidget(button);
}

QStringList NextStepStrip::texts() const {
  QStringList texts;
  for (const NextStep& step : steps_) texts << textOf(step);
  return texts;
}

}  // namespace scantrove
