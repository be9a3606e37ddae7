#include "ui/panels/empty_note.h"

#include <QPainter>

#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {

EmptyNote::EmptyNote(const QString& icon_name, const QString& title, const QString& text, QWidget* parent)
    : QWidget(parent), icon_name_(icon_name), title_(title), text_(text) {
  setAccessibleName(title);
  setAccessibleDescription(text);
}

void EmptyNote::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors& colors = Theme::instance().colors();
  QPainter painter(this);
  const QRect middle(0, height() / 2 - 80, width(), 160);
  icon(icon_name_, colors.muted_text).paint(&painter, QRect(middle.center().x() - 20, middle.top(), 40, 40));
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  painter.setFont(bold);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(middle.adjusted(8, 52, -8, 0), Qt::AlignHCenter | Qt::AlignTop, title_);
  painter.setFont(font());
  painter.setPen(colors.muted_text);
  painter.drawText(middle.adjusted(12, 76, -12, 0), Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap,
                   text_);
}

}  // namespace scantrove
