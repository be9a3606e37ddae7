#pragma once
#include <QLabel>

namespace scantrove {

/// A few words over the 3D view, readable on any scene; the mouse goes through it. Hidden at first.
class ViewLabel : public QLabel {
  Q_OBJECT

 public:
  explicit ViewLabel(QWidget* parent);

  /// Shows `text` with its middle there, as far as it fits into the parent.
  void showAt(const QString& text, const QPointF& middle);
  /// Shows `text` in the `row`-th row from below.
  void showBelow(const QString& text, int row);
};

}  // namespace scantrove
