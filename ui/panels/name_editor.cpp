#include "ui/panels/name_editor.h"

#include <QFocusEvent>
#include <QKeyEvent>
#include <QListView>
#include <QScrollBar>

#include "ui/models/object_list_model.h"
#include "ui/panels/object_delegate.h"

namespace scantrove {
namespace {
constexpr int kLongestName = 120;
}

NameEditor::NameEditor(QListView& list, CatalogueEditor& editor, ObjectListModel& model)
    : QLineEdit(list.viewport()), list_(list), editor_(editor), model_(model) {
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
}

void NameEditor::begin(ObjectId object) {
  if (object != object_ && finish()) {
    const ObjectRecord* record = model_.record(object);
    if (record == nullptr) return;
    object_ = object;
    name_before_ = QString::fromStdString(record->name);
    setText(name_before_);
    selectAll();
    list_.scrollTo(model_.indexOf(object));
    place();
    show();
  }
  setFocus(Qt::OtherFocusReason);
}

bool NameEditor::finish() {
  if (isOpen() && text() != name_before_ && !editor_.rename(object_, text())) return false;
  close();
  return true;
}

void NameEditor::cancel() { close(); }

void NameEditor::close() {
  object_ = {};
  const bool had_focus = hasFocus();
  hide();
  if (had_focus) list_.setFocus(Qt::OtherFocusReason);
}

void NameEditor::place() {
  const QModelIndex row = model_.indexOf(object_);
  // Without a row it stays where it is.
  if (row.isValid()) setGeometry(ObjectDelegate::nameRect(list_.visualRect(row)));
}

void NameEditor::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    finish();
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
  if (text().trimmed().isEmpty()) {
    cancel();
  } else {
    finish();
  }
}

}  // namespace scantrove
