#pragma once
#include <QObject>
#include <QPointer>
#include <QWidget>
#include <vector>

namespace scantrove {

/// Keeps bars over the lower edge of a widget, so that they take no room from it when they appear: what lies
/// under the pointer stays there. A bar is as wide as the widget and as high as its text needs.
class FloatingBars : public QObject {
 public:
  /// A part of `under`, which needs a parent.
  explicit FloatingBars(QWidget& under);

  /// Makes `bar` a child of the parent of the widget. It lies below those that were added before; hidden ones
  /// leave no gap.
  void add(QWidget& bar);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void arrange();

  QWidget& under_;
  std::vector<QPointer<QWidget>> bars_;
};

}  // namespace scantrove
