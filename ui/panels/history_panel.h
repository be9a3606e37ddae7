#pragma once
#include <QWidget>

class QUndoStack;

namespace scantrove {

/// List of the undo steps, newest last. A click undoes or redoes up to that step.
class HistoryPanel : public QWidget {
  Q_OBJECT

 public:
  explicit HistoryPanel(QUndoStack& undo, QWidget* parent = nullptr);
};

}  // namespace scantrove
