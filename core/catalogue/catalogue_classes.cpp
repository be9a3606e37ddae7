#include "core/catalogue/catalogue_classes.h"

#include "core/catalogue/object_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

/// For operations that need no objects.
Result<void> readNoObjects(ObjectRows& /*rows*/) { return {}; }

}  // namespace

Result<ClassId> CatalogueClasses::add(const ClassDraft& draft) {
  return changeCatalogue(connection_, readNoObjects,
                         [&](CatalogueModel& model) { return model.addClass(draft); });
}

Result<ObjectClass> CatalogueClasses::edit(const ClassDraft& draft) {
  return changeCatalogue(connection_, readNoObjects,
                         [&](CatalogueModel& model) { return model.editClass(draft); });
}

Result<ClassMerge> CatalogueClasses::merge(std::span<const ClassId> from, ClassId into) {
  return changeCatalogue(connection_, readNoObjects,
                         [&](CatalogueModel& model) { return model.mergeClasses(from, into); });
}

Result<void> CatalogueClasses::unmerge(const ClassMerge& merge) {
  return changeCatalogue(connection_, readNoObjects,
                         [&](CatalogueModel& model) { return model.unmergeClasses(merge); });
}

Result<void> CatalogueClasses::hide(std::span<const ClassId> ids) {
  return changeCatalogue(
      connection_,
      [&](ObjectRows& rows) -> Result<void> {
        for (const ClassId id : ids) SCANTROVE_TRY(rows.readOfClass(id));
        return {};
      },
      [&](CatalogueModel& model) { return model.hideClasses(ids); });
}

Result<void> CatalogueClasses::restore(std::span<const ClassId> ids) {
  return changeCatalogue(connection_, readNoObjects,
                         [&](CatalogueModel& model) { return model.restoreClasses(ids); });
}

Result<ClassImport> CatalogueClasses::import(std::span<const ClassDraft> list) {
  return changeCatalogue(
      connection_, [](ObjectRows& rows) { return rows.readAll(); },
      [&](CatalogueModel& model) { return importClasses(model, list); });
}

Result<std::vector<Reclassified>> CatalogueClasses::classify(std::span<const ObjectId> objects,
                                                             ClassId class_id) {
  return changeCatalogue(
      connection_, [&](ObjectRows& rows) { return rows.read(objects); },
      [&](CatalogueModel& model) { return model.classify(objects, class_id); });
}

Result<std::vector<Reclassified>> CatalogueClasses::answer(std::span<const ObjectId> objects,
                                                           const std::string& attribute,
                                                           const std::string& value) {
  return changeCatalogue(
      connection_, [&](ObjectRows& rows) { return rows.read(objects); },
      [&](CatalogueModel& model) { return model.answer(objects, attribute, value); });
}

Result<bool> CatalogueClasses::revert(std::span<const Reclassified> changes) {
  return changeCatalogue(
      connection_,
      [&](ObjectRows& rows) -> Result<void> {
        for (const Reclassified& change : changes) SCANTROVE_TRY(rows.read(change.object));
        return {};
      },
      [&](CatalogueModel& model) { return model.revertReclassified(changes); });
}

}  // namespace scantrove
