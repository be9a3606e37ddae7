#include "ui/panels/object_attributes.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QTimer>
#include <algorithm>
#include <utility>

namespace scantrove {

ObjectAttributes::ObjectAttributes(CatalogueEditor& editor, QWidget* parent)
    : QWidget(parent), answers_(editor), form_(new QFormLayout(this)), note_(new QLabel) {
  form_->setContentsMargins(0, 0, 0, 0);
  note_->setWordWrap(true);
  note_->setProperty("muted", true);
  note_->setText(tr("Its class has no attributes. “Classes” in the menu “Edit” adds some."));
  form_->addRow(note_);
}

void ObjectAttributes::showObject(ObjectId object) {
  std::vector<ObjectQuestion> now = answers_.questions(object);
  const bool are_same =
      object == object_ &&
      std::ranges::equal(now, questions_, {}, &ObjectQuestion::attribute, &ObjectQuestion::attribute);
  object_ = object;
  questions_ = std::move(now);
  if (!are_same) {
    while (form_->rowCount() > 1) form_->removeRow(1);
    fields_.clear();
    for (const ObjectQuestion& question : questions_) {
      fields_.push_back(makeField(question));
      form_->addRow(QString::fromStdString(question.attribute.name), fields_.back());
    }
  }
  for (std::size_t i = 0; i < fields_.size(); ++i) fill(*fields_[i], questions_[i].answer);
  note_->setVisible(questions_.empty());
}

QWidget* ObjectAttributes::makeField(const ObjectQuestion& question) {
  const QString name = QString::fromStdString(question.attribute.name);
  if (question.attribute.kind == AttributeKind::text) {
    auto* line = new QLineEdit;
    line->setAccessibleName(name);
    connect(line, &QLineEdit::editingFinished, this, [this, line, name] {
      line->setModified(false);
      give(name, line->text());
    });
    return line;
  }
  auto* box = new QComboBox;
  box->setAccessibleName(name);
  box->addItem(tr("not answered"), QString());
  if (question.attribute.kind == AttributeKind::yes_no) {
    box->addItem(tr("yes"), QStringLiteral("yes"));
    box->addItem(tr("no"), QStringLiteral("no"));
  }
  for (const std::string& choice : question.attribute.choices)
    box->addItem(QString::fromStdString(choice), QString::fromStdString(choice));
  connect(box, &QComboBox::activated, this, [this, box, name] { give(name, box->currentData().toString()); });
  return box;
}

void ObjectAttributes::fill(QWidget& field, const QString& answer) {
  if (auto* line = qobject_cast<QLineEdit*>(&field)) {
    if (!line->hasFocus() || !line->isModified()) line->setText(answer);
  } else if (auto* box = qobject_cast<QComboBox*>(&field)) {
    box->setCurrentIndex(std::max(0, box->findData(answer)));
  }
}

void ObjectAttributes::give(const QString& attribute, const QString& answer) {
  const auto question = std::ranges::find(questions_, attribute.toStdString(),
                                          [](const ObjectQuestion& one) { return one.attribute.name; });
  if (question == questions_.end() || question->answer == answer.trimmed()) return;
  question->answer = answer.trimmed();
  // Later: the change reads the fields anew. A refused answer goes back to the stored one.
  QTimer::singleShot(0, this, [this, attribute, answer, object = object_] {
    if (!answers_.answer(object, attribute, answer)) showObject(object_);
  });
}

}  // namespace scantrove
