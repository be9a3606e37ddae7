#include "ui/panels/object_delegate.h"

#include <QLineEdit>
#include <QPainter>
#include <QPainterPath>

#include "ui/models/object_list_model.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kRowHeight = 70;
constexpr int kPicture = 54;
constexpr int kPadding = 8;

QRect pictureRect(const QRect& row) {
  return {row.left() + kPadding + 4, row.top() + (row.height() - kPicture) / 2, kPicture, kPicture};
}

QRect textRect(const QRect& row) { return row.adjusted(kPicture + 3 * kPadding + 4, 0, -kPadding - 26, 0); }

void paintPicture(QPainter* painter, const QRect& rect, const QImage& picture, const ThemeColors& colors) {
  QPainterPath shape;
  shape.addRoundedRect(rect, 6, 6);
  painter->save();
  painter->setClipPath(shape);
  painter->fillRect(rect, colors.dark ? QColor(0x15, 0x17, 0x1b) : QColor(0xe4, 0xe8, 0xed));
  if (!picture.isNull()) {
    const QSize fitted = picture.size().scaled(rect.size(), Qt::KeepAspectRatio);
    const QPoint corner = rect.center() - QPoint(fitted.width() / 2 - 1, fitted.height() / 2 - 1);
    painter->drawImage(QRect(corner, fitted), picture);
  }
  painter->restore();
}

void paintTag(QPainter* painter, const QPoint& left_centre, const QString& text, const QColor& color) {
  QFont font = painter->font();
  font.setPointSizeF(font.pointSizeF() * 0.82);
  font.setWeight(QFont::DemiBold);
  painter->setFont(font);
  const QFontMetrics metrics(font);
  const QRect chip(left_centre.x(), left_centre.y() - metrics.height() / 2 - 1,
                   metrics.horizontalAdvance(text) + 12, metrics.height() + 2);
  QColor fill = color;
  fill.setAlpha(38);
  painter->setPen(Qt::NoPen);
  painter->setBrush(fill);
  painter->drawRoundedRect(chip, chip.height() / 2.0, chip.height() / 2.0);
  painter->setPen(color);
  painter->drawText(chip, Qt::AlignCenter, text);
}

}  // namespace

QSize ObjectDelegate::sizeHint(const QStyleOptionViewItem& /*option*/, const QModelIndex& /*index*/) const {
  return {220, kRowHeight};
}

void ObjectDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                           const QModelIndex& index) const {
  const ThemeColors& colors = Theme::instance().colors();
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setRenderHint(QPainter::SmoothPixmapTransform);
  const QRect card = option.rect.adjusted(4, 2, -4, -2);
  const bool selected = option.state.testFlag(QStyle::State_Selected);
  if (selected || option.state.testFlag(QStyle::State_MouseOver)) {
    QColor fill = colors.accent;
    fill.setAlpha(selected ? 46 : 20);
    painter->setPen(option.state.testFlag(QStyle::State_HasFocus) ? QPen(colors.accent, 1) : QPen(Qt::NoPen));
    painter->setBrush(fill);
    painter->drawRoundedRect(QRectF(card).adjusted(0.5, 0.5, -0.5, -0.5), 8, 8);
  }
  if (index.data(ObjectListModel::InViewRole).toBool()) {
    painter->setPen(Qt::NoPen);
    painter->setBrush(colors.accent);
    painter->drawRoundedRect(QRectF(card.left() + 2, card.top() + 12, 3, card.height() - 24), 1.5, 1.5);
  }
  paintPicture(painter, pictureRect(card), index.data(Qt::DecorationRole).value<QImage>(), colors);

  const QRect text = textRect(card);
  QFont bold = option.font;
  bold.setWeight(QFont::DemiBold);
  painter->setFont(bold);
  painter->setPen(option.palette.color(QPalette::Text));
  const bool recognised = index.data(ObjectListModel::RecognisedRole).toBool();
  const bool tagged = recognised || index.data(ObjectListModel::AddedNowRole).toBool();
  const QFontMetrics metrics(bold);
  const QString name = metrics.elidedText(index.data(Qt::DisplayRole).toString(), Qt::ElideRight,
                                          text.width() - (tagged ? 52 : 0));
  painter->drawText(text.adjusted(0, 12, 0, 0), Qt::AlignLeft | Qt::AlignTop, name);
  if (tagged) {
    const QPoint left(text.left() + metrics.horizontalAdvance(name) + 8,
                      text.top() + 13 + metrics.height() / 2);
    paintTag(painter, left, recognised ? tr("known") : tr("new"), recognised ? colors.info : colors.warning);
  }

  QFont small = option.font;
  small.setPointSizeF(option.font.pointSizeF() * 0.88);
  painter->setFont(small);
  painter->setPen(colors.muted_text);
  const QString details =
      QStringLiteral("%1 · %2").arg(viewsInWords(index.data(ObjectListModel::ViewCountRole).toInt()),
                                    index.data(ObjectListModel::SizeTextRole).toString());
  const QRect line(text.left(), card.bottom() - 32, card.right() - kPadding - text.left(), 22);
  painter->drawText(line, Qt::AlignVCenter | Qt::AlignLeft,
                    QFontMetrics(small).elidedText(details, Qt::ElideRight, line.width()));

  if (index.data(ObjectListModel::ConfirmedRole).toBool()) {
    icon(QStringLiteral("confirm"), colors.good)
        .paint(painter, QRect(card.right() - kPadding - 18, card.top() + 11, 18, 18));
  }
  painter->restore();
}

QWidget* ObjectDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem& /*option*/,
                                      const QModelIndex& /*index*/) const {
  auto* editor = new QLineEdit(parent);
  editor->setObjectName(QStringLiteral("objectNameEditor"));
  editor->setAccessibleName(tr("Name of the object"));
  editor->setMaxLength(120);
  return editor;
}

void ObjectDelegate::updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                                          const QModelIndex& /*index*/) const {
  const QRect text = textRect(option.rect.adjusted(4, 2, -4, -2));
  editor->setGeometry(text.left() - 8, text.top() + 5, text.width() + 30, 30);
}

}  // namespace scantrove
