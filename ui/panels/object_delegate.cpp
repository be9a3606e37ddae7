#include "ui/panels/object_delegate.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "ui/models/object_list_model.h"
#include "ui/panels/coverage_ring.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kTagFill = 24;  ///< of 255: a tag keeps 4.5 : 1 between text and fill
constexpr int kRowHeight = 70;
constexpr int kMinWidth = 120;
constexpr int kPicture = 54;
constexpr int kPadding = 8;
constexpr int kConfirmedWidth = 26;  ///< width of the tick beside the name
constexpr int kLineGap = 2;
constexpr int kRing = 22;  ///< diameter of the ring of seen sides

QRect textRect(const QRect& row) {
  return row.adjusted(kPicture + 3 * kPadding + 4, 0, -kPadding - kConfirmedWidth, 0);
}

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

QRect paintLine(QPainter* painter, const QRect& room, const QFont& font, const QString& text) {
  const QFontMetrics metrics(font);
  const QRect line(room.left(), room.top(), room.width(), metrics.height());
  painter->setFont(font);
  painter->drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                    metrics.elidedText(text, Qt::ElideRight, line.width()));
  return line;
}

void paintTag(QPainter* painter, const QPoint& top_left, const QFont& font, const QString& text,
              const QColor& color) {
  const QFontMetrics metrics(font);
  const QRect chip(top_left, QSize(metrics.horizontalAdvance(text) + 12, metrics.height() + 2));
  QColor fill = color;
  fill.setAlpha(kTagFill);
  painter->setPen(Qt::NoPen);
  painter->setBrush(fill);
  painter->drawRoundedRect(chip, chip.height() / 2.0, chip.height() / 2.0);
  painter->setFont(font);
  painter->setPen(color);
  painter->drawText(chip, Qt::AlignCenter, text);
}

/// Paints name, class, views and size, and below them a tag if the object is new or known; centred in `room`.
void paintTexts(QPainter* painter, const QRect& room, const QStyleOptionViewItem& option,
                const QModelIndex& index) {
  const ThemeColors& colors = Theme::instance().colors();
  QFont bold = option.font;
  bold.setWeight(QFont::DemiBold);
  QFont small = option.font;
  small.setPointSizeF(option.font.pointSizeF() * 0.88);
  QFont tag_font = option.font;
  tag_font.setPointSizeF(option.font.pointSizeF() * 0.78);
  tag_font.setWeight(QFont::DemiBold);
  const bool recognized = index.data(ObjectListModel::RecognizedRole).toBool();
  const bool changed = !index.data(ObjectListModel::ChangeRole).toString().isEmpty();
  const bool tagged = changed || recognized || index.data(ObjectListModel::AddedNowRole).toBool();
  const int tag_height = tagged ? QFontMetrics(tag_font).height() + 4 : 0;
  const int all = QFontMetrics(bold).height() + kLineGap + QFontMetrics(small).height() + tag_height;

  painter->setPen(option.palette.color(QPalette::Text));
  QRect rest = room.adjusted(0, std::max(0, (room.height() - all) / 2), 0, 0);
  rest.setTop(paintLine(painter, rest, bold, index.data(Qt::DisplayRole).toString()).bottom() + kLineGap + 1);
  painter->setPen(colors.muted_text);
  QStringList details;
  const QString class_name = index.data(ObjectListModel::ClassNameRole).toString();
  if (!class_name.isEmpty()) {
    const int dot = QFontMetrics(small).ascent() / 2;
    const QRect square(rest.left(), rest.top() + (QFontMetrics(small).height() - dot) / 2, dot, dot);
    painter->save();
    painter->setPen(Qt::NoPen);
    painter->setBrush(index.data(ObjectListModel::ClassColorRole).value<QColor>());
    painter->drawEllipse(square);
    painter->restore();
    rest.setLeft(square.right() + 4);
    details << class_name;
  }
  details << viewsInWords(index.data(ObjectListModel::ViewCountRole).toInt())
          << index.data(ObjectListModel::SizeTextRole).toString();
  rest.setTop(paintLine(painter, rest, small, details.join(QStringLiteral(" · "))).bottom() + 3);
  rest.setLeft(room.left());
  if (changed) {
    paintTag(painter, rest.topLeft(), tag_font, ObjectDelegate::tr("changed"), colors.warning);
  } else if (tagged) {
    paintTag(painter, rest.topLeft(), tag_font,
             recognized ? ObjectDelegate::tr("known") : ObjectDelegate::tr("new"),
             recognized ? colors.info : colors.warning);
  }
}

}  // namespace

QSize ObjectDelegate::sizeHint(const QStyleOptionViewItem& /*option*/, const QModelIndex& /*index*/) const {
  return {kMinWidth, kRowHeight};
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
  paintPicture(painter, pictureRect(option.rect), index.data(Qt::DecorationRole).value<QImage>(), colors);

  paintTexts(painter, textRect(card), option, index);
  if (index.data(ObjectListModel::ConfirmedRole).toBool()) {
    icon(QStringLiteral("confirm"), colors.good)
        .paint(painter, QRect(card.right() - kPadding - 18, card.top() + 11, 18, 18));
  }
  if (const QVariant sides = index.data(ObjectListModel::SeenSidesRole); sides.isValid()) {
    const QRectF square(card.right() - kPadding - kRing, card.bottom() - kPadding - kRing, kRing, kRing);
    paintCoverageRing(painter, square, sides.value<SeenSides>(), colors);
  }
  painter->restore();
}

QRect ObjectDelegate::pictureRect(const QRect& row) {
  const QRect card = row.adjusted(4, 2, -4, -2);
  return {card.left() + kPadding + 4, card.top() + (card.height() - kPicture) / 2, kPicture, kPicture};
}

QRect ObjectDelegate::nameRect(const QRect& row) {
  const QRect text = textRect(row.adjusted(4, 2, -4, -2));
  return {text.left() - 8, text.top() + 5, text.width() + 30, 38};
}

}  // namespace scantrove
