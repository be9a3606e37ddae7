#pragma once
#include <QLabel>

namespace scantrove {

/// A text over the 3D view, readable on any scene and transparent to the mouse. Hidden at first.
class ViewLabel : public QLabel {
  Q_OBJECT

 public:
  explicit ViewLabel(QWidget* parent);

  /// Shows `text` centred at `middle`, moved to fit into the parent.
  void showAt(const QString& text, const QPointF& middle);
  /// Shows `text` in the `row`-th row from below.
  void showBelow(const QString& text, int row);
};

}  // namespace scantrove
