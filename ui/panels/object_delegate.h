#pragma once
#include <QStyledItemDelegate>

namespace scantrove {

/// Paints one row of the object list: picture, name, size and number of views, and what is known of the
/// object.
class ObjectDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

  /// Where the name can be edited in a row that is drawn there.
  [[nodiscard]] static QRect nameRect(const QRect& row);
};

}  // namespace scantrove
