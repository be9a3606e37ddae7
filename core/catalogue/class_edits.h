#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"
#include "core/catalogue/class_table.h"

namespace scantrove {

/// Operations of CatalogueModel on its list of classes; the model describes them. All that is given outlives
/// this.
class ClassEdits {
 public:
  /// `place`: how messages call the catalogue. Changes are appended to `changes`.
  ClassEdits(ClassTable& classes, const std::string& place, std::vector<CatalogueChange>& changes)
      : classes_(classes), place_(place), changes_(changes) {}

  /// Error: no such class; it is hidden; it was merged (says into which).
  [[nodiscard]] Result<ObjectClass> shown(ClassId id) const;
  [[nodiscard]] Result<ClassId> add(const ClassDraft& draft);
  [[nodiscard]] Result<ObjectClass> edit(const ClassDraft& draft);
  [[nodiscard]] Result<ClassMerge> merge(std::span<const ClassId> from, ClassId into);
  [[nodiscard]] Result<void> unmerge(const ClassMerge& merge);
  /// No object has the classes.
  [[nodiscard]] Result<void> hide(std::span<const ClassId> ids);
  [[nodiscard]] Result<void> restore(std::span<const ClassId> ids);

 private:
  void apply(CatalogueChange::Kind kind, const ObjectClass& after);
  /// Shows a hidden class again.
  void applyShown(CatalogueChange::Kind kind, ClassId id);

  ClassTable& classes_;
  const std::string& place_;
  std::vector<CatalogueChange>& changes_;
};

}  // namespace scantrove
