#include "ui/models/object_renamer.h"

#include <QObject>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/catalogue/name_completion.h"
#include "core/catalogue/object_database.h"
#include "ui/models/catalogue_editor.h"
#include "ui/models/one_change.h"

namespace scantrove {
namespace {

/// What one naming did, to undo it.
struct RenameEffect {
  std::optional<ObjectMerge> merge;
  ObjectId object;  ///< has the name now
  std::string name_before;
  NamedBy named_by_before = NamedBy::program;
  std::vector<Reclassified> reclassified;
  ClassId made_class;
};

Result<void> giveClass(ObjectDatabase& database, const std::string& class_name, RenameEffect& effect) {
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  ClassId class_id;
  if (const ObjectClass* known = catalogue->classes().named(class_name)) {
    class_id = known->id;
  } else {
    SCANTROVE_TRY(moveInto(effect.made_class, database.classes().add({.name = class_name})));
    class_id = effect.made_class;
  }
  return moveInto(effect.reclassified, database.classes().classify(std::array{effect.object}, class_id));
}

/// Names `object`, after merging it with `same` if there is one.
Result<RenameEffect> renameObject(ObjectDatabase& database, ObjectId object, ObjectId same,
                                  const GivenName& given) {
  RenameEffect effect;
  effect.object = object;
  if (same) {
    Result<ObjectMerge> merge = database.merge(std::array{object, same});
    if (!merge) return fail(merge.error());
    effect.object = merge->into;
    effect.merge = std::move(*merge);
  }
  const Result<ObjectRecord> before = database.object(effect.object);
  if (!before) return fail(before.error());
  effect.name_before = before->name;
  effect.named_by_before = before->named_by;
  SCANTROVE_TRY(database.rename(effect.object, given.name));
  SCANTROVE_TRY(giveClass(database, given.class_name, effect));
  return effect;
}

Result<void> revertRename(ObjectDatabase& database, const RenameEffect& effect) {
  const Result<bool> is_reverted = database.classes().revert(effect.reclassified);
  if (!is_reverted) return fail(is_reverted.error());
  SCANTROVE_TRY(database.rename(effect.object, effect.name_before, effect.named_by_before));
  if (effect.merge) SCANTROVE_TRY(database.unmerge(*effect.merge));
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  const ObjectClass* made = catalogue->classes().find(effect.made_class);
  if (made == nullptr || made->hidden || catalogue->isUsed(made->id)) return {};
  return database.classes().hide(std::array{made->id});
}

}  // namespace

void ObjectRenamer::begin(ObjectId object) {
  object_ = object;
  catalogue_ = editor_.catalogue();
}

std::optional<TypedName> ObjectRenamer::check(const QString& text) const {
  const Result<NameCompletion> completion =
      completeName(catalogue_, text.toStdString(), catalogue_.mergeRoot(object_));
  if (!completion) return std::nullopt;
  TypedName typed;
  typed.class_name = QString::fromStdString(completion->class_name);
  typed.is_new_class = !completion->class_id;
  typed.is_taken = bool(completion->same);
  typed.another = anotherInWords(typed.class_name, QString::fromStdString(completion->name));
  typed.same = sameInWords(typed.class_name, QString::fromStdString(completion->typed));
  return typed;
}

bool ObjectRenamer::apply(ObjectId object, const QString& text, TypedName::Answer answer) {
  const CatalogueModel catalogue = editor_.catalogue();
  const ObjectId root = catalogue.mergeRoot(object);
  const Result<NameCompletion> completion = completeName(catalogue, text.toStdString(), root);
  if (!root || !completion) return editor_.rename(object, text);  // says what is wrong
  const bool is_same = completion->same && answer == TypedName::Answer::same;
  const GivenName given{is_same ? completion->typed : completion->name, completion->class_name};
  const QString before = QString::fromStdString(catalogue.find(root)->name);
  const QString after = QString::fromStdString(given.name);
  const auto effect = std::make_shared<RenameEffect>();
  const ObjectId same = is_same ? completion->same : ObjectId{};
  return editor_.perform(
      (is_same ? QObject::tr("Merge “%1” with “%2”") : QObject::tr("Rename “%1” to “%2”")).arg(before, after),
      asOneChange([root, same, given, effect](ObjectDatabase& database) {
        return moveInto(*effect, renameObject(database, root, same, given));
      }),
      asOneChange([effect](ObjectDatabase& database) { return revertRename(database, *effect); }));
}

}  // namespace scantrove
