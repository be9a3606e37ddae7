#include "ui/models/class_editor.h"

#include <QFileInfo>
#include <QObject>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/catalogue/class_list.h"
#include "core/catalogue/object_database.h"
#include "core/exchange/atomic_file.h"
#include "ui/models/catalogue_editor.h"
#include "ui/models/one_change.h"

namespace scantrove {
namespace {

/// What an import changed, to undo it.
struct ImportEffect {
  ClassTable before, after;
};

Result<ClassTable> classesIn(ObjectDatabase& database) {
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  return catalogue->classes();
}

/// Makes the classes what they were before an import, as far as nobody changed them since, and nothing else
/// uses them.
Result<void> revertImport(ObjectDatabase& database, const ImportEffect& effect) {
  const Result<CatalogueModel> catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  std::vector<ClassId> to_hide;
  std::vector<ClassDraft> to_edit;
  for (const auto& [id, now] : catalogue->classes().all()) {
    const ObjectClass *earlier = effect.before.find(id), *imported = effect.after.find(id);
    if (now.hidden || imported == nullptr || *imported != now) continue;
    if (earlier != nullptr && *earlier == now) continue;
    if (earlier != nullptr) to_edit.push_back(draftOf(*earlier));
    // An object may have it by now; then it stays.
    if ((earlier == nullptr || earlier->hidden) && !catalogue->isUsed(id)) to_hide.push_back(id);
  }
  // A name may still be that of a class which gets its own name back later.
  while (!to_edit.empty()) {
    Error last;
    const auto failed = std::partition(to_edit.begin(), to_edit.end(), [&](const ClassDraft& draft) {
      const Result<ObjectClass> edited = database.classes().edit(draft);
      if (!edited) last = edited.error();
      return !edited;
    });
    if (failed == to_edit.end()) return fail(std::move(last));
    to_edit.erase(failed, to_edit.end());
  }
  return database.classes().hide(to_hide);
}

/// What takes `edit` back from the class that was `before` it. Others may have changed the rest since.
ClassDraft inverseOf(const ClassDraft& edit, const ObjectClass& before) {
  ClassDraft inverse{.id = before.id};
  if (!edit.name.empty()) inverse.name = before.name;
  if (edit.color) inverse.color = before.color;
  if (edit.supercategory) inverse.supercategory = before.supercategory;
  if (edit.attributes) inverse.attributes = before.attributes;
  return inverse;
}

}  // namespace

std::vector<ListedClass> ClassEditor::classes() const {
  const CatalogueModel catalogue = editor_.catalogue();
  std::map<ClassId, int> counts;
  for (const auto& [id, object] : catalogue.objects()) {
    const ObjectClass* own = object.hidden ? nullptr : catalogue.classOf(object.classification);
    if (own != nullptr) ++counts[own->id];
  }
  std::vector<ListedClass> list;
  for (ObjectClass& one : catalogue.classes().visible()) {
    one.attributes = catalogue.classes().attributesOf(one.id);
    const int objects = counts[one.id];
    list.push_back({std::move(one), objects});
  }
  return list;
}

bool ClassEditor::add(const QString& name) {
  const auto id = std::make_shared<ClassId>();
  return editor_.perform(
      QObject::tr("Add class “%1”").arg(name.trimmed()),
      [id, name = name.toStdString()](ObjectDatabase& database) {
        return moveInto(*id, database.classes().add({.name = name}));
      },
      [id](ObjectDatabase& database) { return database.classes().hide(std::array{*id}); });
}

bool ClassEditor::edit(const ClassDraft& draft) {
  const CatalogueModel catalogue = editor_.catalogue();
  const ObjectClass* known = catalogue.classes().find(draft.id);
  const QString name = known != nullptr ? QString::fromStdString(known->name) : QString();
  const bool is_renamed = !draft.name.empty() && known != nullptr && draft.name != known->name;
  const auto before = std::make_shared<ObjectClass>();
  return editor_.perform(
      is_renamed
          ? QObject::tr("Rename class “%1” to “%2”").arg(name, QString::fromStdString(draft.name).trimmed())
          : QObject::tr("Edit class “%1”").arg(name),
      [before, draft](ObjectDatabase& database) { return moveInto(*before, database.classes().edit(draft)); },
      [before, draft](ObjectDatabase& database) -> Result<void> {
        const Result<ObjectClass> edited = database.classes().edit(inverseOf(draft, *before));
        if (!edited) return fail(edited.error());
        return {};
      });
}

bool ClassEditor::merge(const std::vector<ClassId>& from, ClassId into) {
  const auto merged = std::make_shared<ClassMerge>();
  return editor_.perform(
      QObject::tr("Merge %n classes", nullptr, static_cast<int>(from.size()) + 1),
      [from, into, merged](ObjectDatabase& database) {
        return moveInto(*merged, database.classes().merge(from, into));
      },
      [merged](ObjectDatabase& database) { return database.classes().unmerge(*merged); });
}

bool ClassEditor::hide(const std::vector<ClassId>& classes) {
  return editor_.perform(
      classes.size() == 1 ? QObject::tr("Delete class")
                          : QObject::tr("Delete %n classes", nullptr, static_cast<int>(classes.size())),
      [classes](ObjectDatabase& database) { return database.classes().hide(classes); },
      [classes](ObjectDatabase& database) { return database.classes().restore(classes); });
}

std::optional<ClassImport> ClassEditor::importFrom(const QString& file) {
  const Result<std::vector<ClassDraft>> list = readClassList(file.toStdString());
  if (!list) {
    editor_.announce(list.error());
    return std::nullopt;
  }
  const auto effect = std::make_shared<ImportEffect>();
  const auto imported = std::make_shared<ClassImport>();
  const bool is_done = editor_.perform(
      QObject::tr("Import classes from %1").arg(QFileInfo(file).fileName()),
      asOneChange([effect, imported, drafts = *list](ObjectDatabase& database) -> Result<void> {
        SCANTROVE_TRY(moveInto(effect->before, classesIn(database)));
        SCANTROVE_TRY(moveInto(*imported, database.classes().import(drafts)));
        return moveInto(effect->after, classesIn(database));
      }),
      asOneChange([effect](ObjectDatabase& database) { return revertImport(database, *effect); }));
  return is_done ? std::optional(*imported) : std::nullopt;
}

bool ClassEditor::exportTo(const QString& file) {
  if (QFileInfo::exists(file) || QFileInfo(file).isSymLink()) {
    editor_.announce({"The file " + file.toStdString() + " exists already.", "Give the name of a new file."});
    return false;
  }
  const std::vector<ObjectClass> all = editor_.catalogue().classes().visible();
  const bool is_csv = file.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive);
  const Result<void> written =
      writeFileAtomically(file.toStdString(), is_csv ? classListToCsv(all) : classListToJson(all));
  if (!written) editor_.announce(written.error());
  return written.has_value();
}

}  // namespace scantrove
