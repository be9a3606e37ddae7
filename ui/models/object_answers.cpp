#include "ui/models/object_answers.h"

#include <QObject>
#include <array>
#include <memory>

#include "core/catalogue/object_database.h"
#include "ui/models/catalogue_editor.h"

namespace scantrove {

std::vector<ObjectQuestion> ObjectAnswers::questions(ObjectId object) const {
  std::vector<ObjectQuestion> questions;
  const CatalogueModel catalogue = editor_.catalogue();
  const ObjectState* const state = catalogue.visible(object);
  if (state == nullptr) return questions;
  const ObjectClass* const own = catalogue.classOf(state->classification);
  if (own == nullptr) return questions;
  const AttributeValues answers = catalogue.answersOf(state->classification);
  for (ClassAttribute& attribute : catalogue.classes().attributesOf(own->id)) {
    const auto answer = answers.find(attribute.name);
    const QString text = answer == answers.end() ? QString() : QString::fromStdString(answer->second);
    questions.push_back({std::move(attribute), text});
  }
  return questions;
}

bool ObjectAnswers::answer(ObjectId object, const QString& attribute, const QString& answer) {
  const auto changes = std::make_shared<std::vector<Reclassified>>();
  const QString text = answer.trimmed();
  return editor_.perform(
      text.isEmpty() ? QObject::tr("Remove the answer to “%1”").arg(attribute)
                     : QObject::tr("Answer “%1” with “%2”").arg(attribute, text),
      [object, changes, question = attribute.toStdString(),
       value = text.toStdString()](ObjectDatabase& database) {
        return moveInto(*changes, database.classes().answer(std::array{object}, question, value));
      },
      [changes](ObjectDatabase& database) -> Result<void> {
        const Result<bool> is_reverted = database.classes().revert(*changes);
        if (!is_reverted) return fail(is_reverted.error());
        return {};
      });
}

bool ObjectAnswers::areSame(ObjectId a, ObjectId b) { return editor_.merge({a, b}); }

bool ObjectAnswers::areDifferent(ObjectId a, ObjectId b) {
  const CatalogueModel catalogue = editor_.catalogue();
  const auto nameOf = [&catalogue](ObjectId object) {
    const ObjectState* const state = catalogue.visible(object);
    return state != nullptr ? QString::fromStdString(state->name) : QString();
  };
  return editor_.perform(
      QObject::tr("“%1” and “%2” are different").arg(nameOf(a), nameOf(b)),
      [a, b](ObjectDatabase& database) { return database.differences().record(a, b, true); },
      [a, b](ObjectDatabase& database) { return database.differences().record(a, b, false); });
}

}  // namespace scantrove
