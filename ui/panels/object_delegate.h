#pragma once
#include <QStyledItemDelegate>

namespace scantrove {

/// Paints one row of the object list: picture, name, class, number of views, size and state.
class ObjectDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

  /// Rectangle for editing the name in a row with this rectangle.
  [[nodiscard]] static QRect nameRect(const QRect& row);
  /// Rectangle of the picture in such a row.
  [[nodiscard]] static QRect pictureRect(const QRect& row);
};

}  // namespace scantrove
