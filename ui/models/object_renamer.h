#pragma once
#include <QString>
#include <optional>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/catalogue/catalogue_model.h"
#include "ui/models/typed_name.h"

namespace scantrove {

class CatalogueEditor;

/// Names objects of the catalogue as a user types: completeName() gives the name and the class. Each naming
/// is one step that can be undone. It does not confirm the object.
class ObjectRenamer {
 public:
  /// `editor` outlives this.
  explicit ObjectRenamer(CatalogueEditor& editor) : editor_(editor) {}

  /// Reads the names of the catalogue, for check().
  void begin(ObjectId object);
  /// NameCheck for the object of begin().
  [[nodiscard]] std::optional<TypedName> check(const QString& text) const;
  /// Names the object, or the one that it was merged into. `same`: if another object has the name, the two
  /// become one with that name. False if it failed; CatalogueEditor::failed was emitted.
  [[nodiscard]] bool apply(ObjectId object, const QString& text, TypedName::Answer answer);

 private:
  CatalogueEditor& editor_;
  CatalogueModel catalogue_;
  ObjectId object_;
};

}  // namespace scantrove
