#include "ui/panels/region_name_editor.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QEvent>
#include <QFocusEvent>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QStringListModel>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/panels/same_name_choice.h"

namespace scantrove {
namespace {
constexpr int kLongestRegionName = 120;
constexpr int kNameEditorWidth = 260;
}  // namespace

RegionNameEditor::RegionNameEditor(QWidget* parent)
    : QFrame(parent),
      about_(new QLabel),
      field_(new QLineEdit),
      class_(new QLabel),
      choice_(new SameNameChoice),
      known_(new QStringListModel(this)) {
  setObjectName(QStringLiteral("regionNameEditor"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 8, 10, 8);
  column->setSpacing(4);
  about_->setTextFormat(Qt::PlainText);
  about_->setProperty("muted", true);
  column->addWidget(about_);
  field_->setObjectName(QStringLiteral("regionNameField"));
  field_->setMaxLength(kLongestRegionName);
  field_->setMinimumWidth(kNameEditorWidth);
  field_->setPlaceholderText(tr("Name, class, or class/name"));
  field_->setAccessibleName(tr("Name of the region"));
  auto* completer = new QCompleter(known_, this);
  completer->setCaseSensitivity(Qt::CaseInsensitive);
  completer->setFilterMode(Qt::MatchContains);
  field_->setCompleter(completer);
  column->addWidget(field_);
  class_->setTextFormat(Qt::PlainText);
  class_->setProperty("muted", true);
  column->addWidget(class_);
  column->addWidget(choice_);
  field_->installEventFilter(this);
  connect(field_, &QLineEdit::textChanged, this, &RegionNameEditor::showClass);
  // From the list of completions, which passes keys to the field itself.
  connect(field_, &QLineEdit::returnPressed, this,
          [this] { finish(answerOf(QGuiApplication::keyboardModifiers())); });
  connect(choice_, &SameNameChoice::answered, this, &RegionNameEditor::finish);
  connect(choice_, &SameNameChoice::cancelled, this, &RegionNameEditor::cancel);
  connect(choice_, &SameNameChoice::left, this, [this] {
    if (!field_->hasFocus()) finish(TypedName::Answer::another);
  });
  hide();
}

void RegionNameEditor::begin(Begin what) {
  if (isOpen()) finish(TypedName::Answer::another);
  known_->setStringList(what.known);
  about_->setText(what.about);
  check_ = std::move(what.check);
  before_ = what.text;
  on_screen_ = what.on_screen;
  field_->setText(what.text);
  field_->selectAll();
  showClass(what.text);
  show();
  raise();
  field_->setFocus(Qt::OtherFocusReason);
}

void RegionNameEditor::type(const QString& text) { field_->setText(text); }

void RegionNameEditor::showClass(const QString& text) {
  const std::optional<TypedName> typed =
      check_ && !text.trimmed().isEmpty() ? check_(text) : std::optional<TypedName>();
  class_->setText(typed ? typed->classInWords() : QString());
  class_->setVisible(typed.has_value());
  if (typed && text.trimmed() != before_)
    choice_->ask(*typed);
  else
    choice_->dismiss();
  place();
  // The list of completions opens after this and would cover the answers.
  if (choice_->isAsking()) QTimer::singleShot(0, this, &RegionNameEditor::uncoverAnswers);
}

void RegionNameEditor::uncoverAnswers() {
  if (choice_->isAsking()) field_->completer()->popup()->hide();
}

void RegionNameEditor::place() {
  adjustSize();
  const QPoint requested = parentWidget()->mapFromGlobal(on_screen_) + QPoint(12, 10);
  const QSize room = parentWidget()->size();
  move(std::clamp(requested.x(), 0, std::max(0, room.width() - width())),
       std::clamp(requested.y(), 0, std::max(0, room.height() - height())));
}

TypedName::Answer RegionNameEditor::answerOf(Qt::KeyboardModifiers modifiers) const {
  return choice_->isAsking() && modifiers.testFlag(Qt::ShiftModifier) ? TypedName::Answer::same
                                                                      : TypedName::Answer::another;
}

void RegionNameEditor::finish(TypedName::Answer answer) {
  if (!isOpen()) return;
  const QString text = field_->text().trimmed();
  hide();
  if (text != before_) emit accepted(text, answer);
  emit closed();
}

void RegionNameEditor::cancel() {
  hide();
  emit closed();
}

bool RegionNameEditor::eventFilter(QObject* watched, QEvent* event) {
  // While a name is typed, keys are not shortcuts.
  if (event->type() == QEvent::ShortcutOverride) {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::KeyPress) {
    const auto* const key = static_cast<QKeyEvent*>(event);
    switch (key->key()) {
      case Qt::Key_Escape:
        cancel();
        return true;
      case Qt::Key_Return:
      case Qt::Key_Enter:
        finish(answerOf(key->modifiers()));
        return true;
      case Qt::Key_Tab:
        if (choice_->isAsking()) choice_->enter();
        return true;
      default:
        break;
    }
  }
  if (event->type() == QEvent::FocusOut && isOpen()) {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    const bool is_left = reason != Qt::PopupFocusReason && reason != Qt::ActiveWindowFocusReason;
    if (is_left && !choice_->holdsFocus()) finish(TypedName::Answer::another);
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace scantrove
