#include "ui/panels/same_name_choice.h"

#include <QApplication>
#include <QFocusEvent>
#include <QKeyEvent>
#include <QPushButton>
#include <QVBoxLayout>

namespace scantrove {

SameNameChoice::SameNameChoice(QWidget* parent)
    : QFrame(parent), another_(new QPushButton), same_(new QPushButton) {
  setObjectName(QStringLiteral("sameNameChoice"));
  setAutoFillBackground(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  another_->setToolTip(tr("Another thing of this class (Return)"));
  same_->setToolTip(tr("The same object: the two become one (Shift+Return)"));
  for (QPushButton* button : {another_, same_}) {
    button->setFocusPolicy(Qt::StrongFocus);
    button->setAutoDefault(false);
    button->installEventFilter(this);
    column->addWidget(button);
  }
  connect(another_, &QPushButton::clicked, this, [this] { emit answered(TypedName::Answer::another); });
  connect(same_, &QPushButton::clicked, this, [this] { emit answered(TypedName::Answer::same); });
  hide();
}

void SameNameChoice::ask(const TypedName& typed) {
  if (!typed.is_taken) return hide();
  another_->setText(tr("%1 (Return)").arg(typed.another));
  same_->setText(tr("%1 (Shift+Return)").arg(typed.same));
  show();
  updateGeometry();  // a layout around this has kept the size of shorter texts
}

void SameNameChoice::enter() { another_->setFocus(Qt::TabFocusReason); }

bool SameNameChoice::holdsFocus() const { return another_->hasFocus() || same_->hasFocus(); }

bool SameNameChoice::eventFilter(QObject* watched, QEvent* event) {
  auto* const button = static_cast<QPushButton*>(watched);
  if (event->type() == QEvent::ShortcutOverride) {
    event->accept();  // keys are no shortcuts here
    return true;
  }
  if (event->type() == QEvent::FocusOut) {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    const bool is_left = reason != Qt::PopupFocusReason && reason != Qt::ActiveWindowFocusReason &&
                         QApplication::focusWidget() != another_ && QApplication::focusWidget() != same_;
    if (is_left && isVisible()) emit left();
    return false;
  }
  if (event->type() != QEvent::KeyPress) return false;
  switch (static_cast<QKeyEvent*>(event)->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
      button->click();
      return true;
    case Qt::Key_Escape:
      emit cancelled();
      return true;
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Tab:
    case Qt::Key_Backtab:
      (button == another_ ? same_ : another_)->setFocus(Qt::TabFocusReason);
      return true;
    default:
      return false;
  }
}

}  // namespace scantrove
