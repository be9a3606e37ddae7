#include "ui/panels/name_editor.h"

#include <QFocusEvent>
#include <QKeyEvent>
#include <QScrollBar>
#include <algorithm>

#include "ui/models/object_list_model.h"
#include "ui/panels/object_delegate.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/same_name_choice.h"

namespace scantrove {
namespace {
constexpr int kLongestName = 120;
}

NameEditor::NameEditor(ObjectListView& list, CatalogueEditor& editor, ObjectListModel& model)
    : QLineEdit(list.viewport()),
      list_(list),
      model_(model),
      renamer_(editor),
      choice_(new SameNameChoice(list.viewport())) {
  setObjectName(QStringLiteral("objectNameEditor"));
  setAccessibleName(tr("Name of the object"));
  setMaxLength(kLongestName);
  hide();
  connect(&model_, &ObjectListModel::updated, this, &NameEditor::place);
  connect(&model_, &ObjectListModel::merged, this, [this](ObjectId into, ObjectId from) {
    if (object_ && object_ == from) object_ = into;
  });
  connect(&model_, &QAbstractItemModel::modelReset, this, &NameEditor::cancel);
  connect(list_.verticalScrollBar(), &QAbstractSlider::valueChanged, this, &NameEditor::place);
  connect(this, &QLineEdit::textEdited, this, &NameEditor::showChoice);
  connect(choice_, &SameNameChoice::answered, this, &NameEditor::finish);
  connect(choice_, &SameNameChoice::cancelled, this, &NameEditor::cancel);
  connect(choice_, &SameNameChoice::left, this, [this] {
    if (!hasFocus()) finish();
  });
}

void NameEditor::begin(ObjectId object) {
  if (object != object_ && finish()) {
    const ObjectRecord* record = model_.record(object);
    if (record == nullptr) return;
    object_ = object;
    renamer_.begin(object);
    name_before_ = QString::fromStdString(record->name);
    setText(name_before_);
    selectAll();
    list_.scrollTo(list_.rowOf(object));
    place();
    show();
  }
  setFocus(Qt::OtherFocusReason);
}

bool NameEditor::finish(TypedName::Answer answer) {
  if (isOpen() && text().trimmed() != name_before_ && !renamer_.apply(object_, text(), answer)) return false;
  close();
  return true;
}

void NameEditor::cancel() { close(); }

void NameEditor::close() {
  object_ = {};
  const bool had_focus = hasFocus() || choice_->holdsFocus();
  choice_->dismiss();
  hide();
  if (had_focus) list_.setFocus(Qt::OtherFocusReason);
}

void NameEditor::place() {
  const QModelIndex row = list_.rowOf(object_);
  // Without a row it stays where it is.
  if (row.isValid()) setGeometry(ObjectDelegate::nameRect(list_.visualRect(row)));
  if (!choice_->isAsking()) return;
  const int room = list_.viewport()->width();
  choice_->resize(std::min(room, choice_->sizeHint().width()), choice_->sizeHint().height());
  const bool is_below = geometry().bottom() + choice_->height() < list_.viewport()->height();
  choice_->move(std::max(0, std::min(x(), room - choice_->width())),
                is_below ? geometry().bottom() + 1 : std::max(0, y() - choice_->height()));
  choice_->raise();
}

void NameEditor::showChoice(const QString& text) {
  const std::optional<TypedName> typed = renamer_.check(text);
  choice_->ask(typed && text.trimmed() != name_before_ ? *typed : TypedName());
  place();
}

bool NameEditor::event(QEvent* event) {
  const bool is_tab =
      event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Tab;
  if (!is_tab || !choice_->isAsking()) return QLineEdit::event(event);
  choice_->enter();
  return true;
}

void NameEditor::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    const bool is_same = choice_->isAsking() && event->modifiers().testFlag(Qt::ShiftModifier);
    finish(is_same ? TypedName::Answer::same : TypedName::Answer::another);
  } else if (event->key() == Qt::Key_Escape) {
    cancel();
  } else {
    QLineEdit::keyPressEvent(event);
  }
  event->accept();  // the list must not get these keys
}

void NameEditor::focusOutEvent(QFocusEvent* event) {
  QLineEdit::focusOutEvent(event);
  const Qt::FocusReason reason = event->reason();
  if (reason == Qt::ActiveWindowFocusReason || reason == Qt::PopupFocusReason) return;
  if (choice_->holdsFocus()) return;
  if (text().trimmed().isEmpty()) {
    cancel();
  } else {
    finish();
  }
}

}  // namespace scantrove
