#include "ui/panels/history_panel.h"

#include <QUndoStack>
#include <QUndoView>
#include <QVBoxLayout>

namespace scantrove {

HistoryPanel::HistoryPanel(QUndoStack& undo, QWidget* parent) : QWidget(parent) {
  auto* list = new QUndoView(&undo);
  list->setEmptyLabel(tr("Original scan"));
  list->setAccessibleName(tr("Edits"));
  list->setToolTip(tr("Click a step to return to it"));
  list->setFrameShape(QFrame::NoFrame);
  list->setProperty("panel", true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 0, 4, 6);
  column->addWidget(list);
}

}  // namespace scantrove
