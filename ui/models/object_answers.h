#pragma once
#include <QString>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

class CatalogueEditor;

/// A question of an object's class, and what is answered for the object; empty: nothing.
struct ObjectQuestion {
  ClassAttribute attribute;
  QString answer;
};

/// What a user says of single objects on their pages: answers to the questions of the class, and whether two
/// objects are one thing. Each is one step that can be undone. Functions return false if a change failed;
/// CatalogueEditor::failed was emitted.
class ObjectAnswers {
 public:
  /// `editor` outlives this.
  explicit ObjectAnswers(CatalogueEditor& editor) : editor_(editor) {}

  /// Empty: the object has no class, or its class asks nothing.
  [[nodiscard]] std::vector<ObjectQuestion> questions(ObjectId object) const;
  bool answer(ObjectId object, const QString& attribute, const QString& answer);
  /// Two objects are one: CatalogueModel::merge(), so the name that a user gave stays.
  bool areSame(ObjectId a, ObjectId b);
  /// They are two things, and are not suggested for merging any more.
  bool areDifferent(ObjectId a, ObjectId b);

 private:
  CatalogueEditor& editor_;
};

}  // namespace scantrove
