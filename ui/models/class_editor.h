#pragma once
#include <QString>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/class_import.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

class CatalogueEditor;

/// A class as the window lists it.
struct ListedClass {
  ObjectClass object_class;  ///< its attributes include those of classes that are merged into it
  int objects = 0;           ///< that have it
};

/// Edits the list of classes for the user, by CatalogueModel's rules. Each change is one step that can be
/// undone. Functions return false or none if a change failed; CatalogueEditor::failed was emitted.
class ClassEditor {
 public:
  /// `editor` outlives this.
  explicit ClassEditor(CatalogueEditor& editor) : editor_(editor) {}

  /// Visible classes, by id.
  [[nodiscard]] std::vector<ListedClass> classes() const;

  bool add(const QString& name);
  /// Changes what the draft gives of the class with its id.
  bool edit(const ClassDraft& draft);
  bool merge(const std::vector<ClassId>& from, ClassId into);
  /// Hides classes that no object has.
  bool hide(const std::vector<ClassId>& classes);
  /// Imports a list from a JSON or CSV file (readClassList).
  std::optional<ClassImport> importFrom(const QString& file);
  /// Writes all visible classes to a new file: CSV if it ends so, else JSON.
  bool exportTo(const QString& file);

 private:
  CatalogueEditor& editor_;
};

}  // namespace scantrove
