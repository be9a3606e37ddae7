#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/class_import.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

class DatabaseConnection;

/// The operations of CatalogueModel on classes, and on the classes of objects, in a catalogue on disk. Each
/// is one transaction. ObjectDatabase::model() has the classes.
class CatalogueClasses {
 public:
  explicit CatalogueClasses(DatabaseConnection& connection) : connection_(connection) {}

  [[nodiscard]] Result<ClassId> add(const ClassDraft& draft);
  [[nodiscard]] Result<ObjectClass> edit(const ClassDraft& draft);
  [[nodiscard]] Result<ClassMerge> merge(std::span<const ClassId> from, ClassId into);
  [[nodiscard]] Result<void> unmerge(const ClassMerge& merge);
  [[nodiscard]] Result<void> hide(std::span<const ClassId> ids);
  [[nodiscard]] Result<void> restore(std::span<const ClassId> ids);
  /// importClasses().
  [[nodiscard]] Result<ClassImport> import(std::span<const ClassDraft> list);

  [[nodiscard]] Result<std::vector<Reclassified>> classify(std::span<const ObjectId> objects,
                                                           ClassId class_id);
  [[nodiscard]] Result<std::vector<Reclassified>> answer(std::span<const ObjectId> objects,
                                                         const std::string& attribute,
                                                         const std::string& value);
  [[nodiscard]] Result<bool> revert(std::span<const Reclassified> changes);

 private:
  DatabaseConnection& connection_;
};

}  // namespace scantrove
