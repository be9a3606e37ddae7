#include "ui/panels/history_panel.h"

#include <QUndoGroup>
#include <QUndoView>
#include <QVBoxLayout>

namespace scantrove {

HistoryPanel::HistoryPanel(QUndoGroup& undo, QWidget* parent) : QWidget(parent) {
  auto* list = new QUndoView(&undo);
  list->setEmptyLabel(tr("As it was scanned"));
  list->setAccessibleName(tr("What was done"));
  list->setToolTip(tr("Click on a step to go back to it"));
  list->setFrameShape(QFrame::NoFrame);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 0, 4, 6);
  column->addWidget(list);
}

}  // namespace scantrove
