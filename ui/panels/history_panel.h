#pragma once
#include <QWidget>

class QUndoStack;

namespace scantrove {

/// What was done, in words, newest last; a click goes back to there, or forward again.
class HistoryPanel : public QWidget {
  Q_OBJECT

 public:
  explicit HistoryPanel(QUndoStack& undo, QWidget* parent = nullptr);
};

}  // namespace scantrove
