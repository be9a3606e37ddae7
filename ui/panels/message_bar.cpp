#include "ui/panels/message_bar.h"

#include <QColor>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <utility>

#include "ui/models/shown_message.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

/// `color` with an opacity of 0 ... 255 over `base`. The bar lies over the view, so it is opaque.
QColor colorOver(const QColor& base, const QColor& color, int alpha) {
  const auto mixed = [alpha](int below, int above) { return (above * alpha + below * (255 - alpha)) / 255; };
  return {mixed(base.red(), color.red()), mixed(base.green(), color.green()),
          mixed(base.blue(), color.blue())};
}

}  // namespace

MessageBar::MessageBar(QWidget* parent)
    : QFrame(parent), picture_(new QLabel), label_(new QLabel), button_(new QPushButton) {
  setObjectName(QStringLiteral("messageBar"));
  label_->setObjectName(QStringLiteral("messageText"));
  label_->setWordWrap(true);
  label_->setTextFormat(Qt::PlainText);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setIcon(icon(QStringLiteral("close")));
  close->setIconSize({14, 14});
  close->setToolTip(tr("Dismiss this message"));
  close->setAccessibleName(tr("Dismiss this message"));
  connect(close, &QToolButton::clicked, this, &MessageBar::dismiss);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(14, 8, 8, 8);
  layout->setSpacing(10);
  layout->addWidget(picture_, 0, Qt::AlignTop);
  layout->addWidget(label_, 1);
  layout->addWidget(button_, 0, Qt::AlignTop);
  layout->addWidget(close, 0, Qt::AlignTop);
  button_->setObjectName(QStringLiteral("messageButton"));
  button_->hide();
  connect(button_, &QPushButton::clicked, this, [this] {
    const auto act = std::exchange(act_, {});
    dismiss();
    if (act) act();
  });
  connect(&Theme::instance(), &Theme::changed, this, &MessageBar::paintKind);
  hide();
}

void MessageBar::show(Kind kind, const QString& text) {
  if (!showText(kind, text)) return;
  button_->hide();
  act_ = {};
}

void MessageBar::show(Kind kind, const QString& text, const QString& button_text, std::function<void()> act) {
  if (!showText(kind, text)) return;
  button_->setText(button_text);
  button_->show();
  act_ = std::move(act);
}

bool MessageBar::showText(Kind kind, const QString& message) {
  const QString text = shownMessage(message);
  if (isVisibleTo(parentWidget()) && kind_ == Kind::error && kind != Kind::error) return false;
  repeats_ = isVisibleTo(parentWidget()) && text == text_ ? repeats_ + 1 : 1;
  kind_ = kind;
  text_ = text;
  label_->setText(repeats_ > 1 ? tr("%1  (%2 times)").arg(text, QString::number(repeats_)) : text);
  setAccessibleName(text);
  paintKind();
  QFrame::show();
  return true;
}

void MessageBar::dismiss() {
  text_.clear();
  hide();
}

void MessageBar::paintKind() {
  const ThemeColors& colors = Theme::instance().colors();
  const QColor color =
      kind_ == Kind::error ? colors.bad : (kind_ == Kind::warning ? colors.warning : colors.info);
  picture_->setPixmap(
      icon(kind_ == Kind::info ? QStringLiteral("info") : QStringLiteral("warning"), color).pixmap(20, 20));
  const QColor fill = colorOver(colors.surface, color, colors.dark ? 40 : 28);
  setStyleSheet(QStringLiteral("#messageBar { background: %1; border: none; border-top: 1px solid %2; }")
                    .arg(fill.name(), color.name()));
}

}  // namespace scantrove
